"""The server of the Model Context Protocol: one tool for each command, on standard input and output."""

import logging
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from mechwright.agent.folder import Folder
from mechwright.agent.running import Answer, run, shortened
from mechwright.contracts.finding import Stage
from mechwright.errors import MechwrightError
from mechwright.extras import optional

WORDS = """\
Mechwright designs mechanisms and writes proven programs for the mill. All paths are relative to one folder.
Begin with families, then new, or write a design file. check says what an engineer would object to, with
remedies as changes of keys; fix finds the smallest change. build writes everything. synthesize finds designs
that meet a requirement file. An answer has ok, code, answer (data) and said (lines of text).
"""


Design = Annotated[str, Field(description="A design file (TOML), below the folder.")]
Output = Annotated[str, Field(description="A folder for the files, below the folder.")]
Family = Annotated[str, Field(description="A family's name, as families lists it.")]


class Tools:
    """What a server offers; each method is a tool, and its docstring what an agent reads of it.

    Parameters
    ----------
    folder
        Below which all files are.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder

    def _run(self, *words: str) -> Answer:
        return shortened(run(self._folder.root, words))

    def _file(self, name: str) -> str:
        return self._folder.path(name)

    def families(self) -> Answer:
        """List the families of mechanisms with their titles and what they do."""
        found = run(self._folder.root, ["families", "--json"])
        if found["ok"]:
            keys = ("name", "title", "summary")
            found["answer"] = [{key: one[key] for key in keys} for one in found["answer"]["families"]]
        return found

    def schema(
        self,
        family: Family,
        requirement: Annotated[bool, Field(description="Of requirement files instead.")] = False,
    ) -> Answer:
        """Give the JSON schema of a family's design files: every key with unit, bounds and description."""
        return self._run("schema", *(["--requirement"] if requirement else []), "--", family)

    def new(
        self,
        family: Family,
        file: Annotated[str, Field(description="The new file, such as pair.toml.")],
        requirement: Annotated[str, Field(description="A kind of requirement: a requirement file.")] = "",
        shop: Annotated[str, Field(description="A shop file below the folder.")] = "",
        fit: Annotated[str, Field(description="Largest size of each plate in mm: 120x80.")] = "",
    ) -> Answer:
        """Write a commented design file that builds as it is, or a requirement file."""
        words = ["-o", self._file(file)]
        words += ["--requirement", requirement] if requirement else []
        words += ["--shop", self._file(shop)] if shop else []
        words += ["--fit", fit] if fit else []
        return self._run("new", *words, "--", family)

    def files(self) -> list[str]:
        """List the files below the folder."""
        return self._folder.files()

    def read(
        self,
        file: Annotated[str, Field(description="A text file below the folder.")],
        start: Annotated[int, Field(ge=0, description="The first character that is shown.")] = 0,
    ) -> str:
        """Show a text file: a design, a table, a program."""
        return self._folder.text(file, start)

    def write(
        self,
        file: Annotated[str, Field(description="A .toml or .csv file below the folder.")],
        text: Annotated[str, Field(description="All of its text.")],
        replace: Annotated[bool, Field(description="Whether a file that is there is replaced.")] = False,
    ) -> str:
        """Write a design, requirement or shop file, or a table of numbers."""
        return self._folder.write(file, text, replace=replace)

    def check(
        self,
        design: Design,
        to: Annotated[Stage, Field(description="How far it has to build.")] = Stage.OUTPUT,
    ) -> Answer:
        """Say what an engineer would object to, each finding with its limit, and a fix that was tried."""
        return self._run("check", "--json", "--to", str(to), "--", self._file(design))

    def fix(
        self,
        design: Design,
        to: Annotated[Stage, Field(description="How far it has to build.")] = Stage.OUTPUT,
        write: Annotated[bool, Field(description="Change the design file itself.")] = False,
    ) -> Answer:
        """Find the smallest change with which a design builds."""
        return self._run(
            "fix", "--json", "--to", str(to), *(["--write"] if write else []), "--", self._file(design)
        )

    def solve(self, design: Design, output: Output) -> Answer:
        """Write the motion: tables, and a page that moves."""
        return self._written("solve", design, output)

    def model(
        self,
        design: Design,
        output: Output,
        also: Annotated[str, Field(description="More formats, such as stl,3mf,glb,urdf.")] = "",
    ) -> Answer:
        """Write the solids: parts and assembly as STEP, drawings, bill of materials, assembly guide."""
        return self._written("model", design, output, *(["--also", also] if also else []))

    def cam(self, design: Design, output: Output) -> Answer:
        """Write drawings and proven programs for the mill."""
        return self._written("cam", design, output)

    def build(self, design: Design, output: Output) -> Answer:
        """Write everything: motion, solids, drawings, proven programs, pages."""
        return self._written("build", design, output)

    def _written(self, command: str, design: str, output: str, *more: str) -> Answer:
        return self._run(command, "--json", "-o", self._file(output), *more, "--", self._file(design))

    def synthesize(
        self,
        requirement: Annotated[str, Field(description="A requirement file (TOML), below the folder.")],
        output: Output,
    ) -> Answer:
        """Find designs that meet a requirement: one design file each, best first, with residuals."""
        return self._run("synthesize", "--json", "-o", self._file(output), "--", self._file(requirement))

    def verify(
        self,
        programs: Annotated[list[str], Field(min_length=1, description="Files of one program, in order.")],
        design: Design,
        part: Annotated[str, Field(description="The part of the design that it cuts.")],
    ) -> Answer:
        """Prove that a program cuts a part, whoever wrote the program."""
        of = ["--design", self._file(design), f"--part={part}"]
        return self._run("verify", "--json", *of, "--", *map(self._file, programs))


READ = ("families", "schema", "files", "read", "check", "verify")
"""Names of the methods of :class:`Tools` that write nothing."""

WRITE = ("new", "write", "fix", "solve", "model", "cam", "build", "synthesize")
"""Names of those that write files."""


def server_of(folder: Folder, version: str) -> Any:
    """The server; raises PluginError where the library is not installed."""
    library, types = optional("mcp.server.mcpserver"), optional("mcp.types")
    errors = optional("mcp.server.mcpserver.exceptions")
    made = library.MCPServer("mechwright", instructions=WORDS, version=version, log_level="ERROR")
    tools = Tools(folder)
    for name in (*READ, *WRITE):
        method = getattr(tools, name)
        hints = types.ToolAnnotations(
            read_only_hint=name in READ, destructive_hint=name in WRITE, open_world_hint=False
        )
        made.add_tool(_told(method, errors.ToolError), name=name, annotations=hints)
    return made


def _told(method: Callable[..., Any], error_of: type[Exception]) -> Callable[..., Any]:
    """A method whose errors are a line for the agent."""
    from functools import wraps

    @wraps(method)
    def told(*arguments: Any, **more: Any) -> Any:
        try:
            return method(*arguments, **more)
        except MechwrightError as error:
            raise error_of(str(error)) from None

    return told


NONSENSE = "the client sent a line that is no message of JSON-RPC, and it is ignored; send one message a line"


class _Nonsense(logging.Handler):
    """A line on standard error for what the library cannot read, and logs for debugging alone."""

    def emit(self, record: logging.LogRecord) -> None:
        if "transport yielded exception" in str(record.msg):
            sys.stderr.write(f"mechwright: {NONSENSE}\n")


def serve(root: Path, version: str) -> None:
    """Answer on standard input and output until the client ends; raises DesignError without a folder.

    A line of the client that is no message is told on standard error.
    """
    server = server_of(Folder(root), version)
    reader = logging.getLogger("mcp.shared.jsonrpc_dispatcher")
    reader.setLevel(logging.DEBUG)
    reader.propagate = False
    reader.addHandler(_Nonsense())
    server.run("stdio")
