"""Ways in which a plugin's module can end the process that loads it, or spoil it for everybody else in it.

Each is the text of a module, and a part of the verdict. What a text does to files, processes and limits it does to
the process alone in which it is tried.
"""

ENDS = {
    "exit 0": ("import os; os._exit(0)", "ends the program with exit code 0 while it is loaded"),
    "exit 3": ("import os; os._exit(3)", "ends the program with exit code 3"),
    "exit by a name": ("from os import _exit; _exit(0)", "ends the program with exit code 0"),
    "sys.exit": ("import sys; sys.exit(0)", "SystemExit: 0"),
    "quit": ("raise SystemExit", "SystemExit"),
    "keyboard": ("raise KeyboardInterrupt", "KeyboardInterrupt"),
    "generator": ("raise GeneratorExit", "GeneratorExit"),
    "base": ("class Own(BaseException): pass\nraise Own('of its own')", "Own: of its own"),
    "killed": ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "is killed by SIGKILL"),
    "terminated": (
        "import os, signal; signal.signal(15, 0); os.kill(os.getpid(), 15)",
        "is killed by SIGTERM",
    ),
    "group": ("import os, signal; os.killpg(0, signal.SIGKILL)", "is killed by SIGKILL"),
    "abort": ("import os; os.abort()", "is killed by SIGABRT"),
    "null": ("import ctypes; ctypes.string_at(0)", "is killed by SIGSEGV"),
    "written over": ("import ctypes; ctypes.memset(1, 0, 8)", "is killed by SIGSEGV"),
    "deep": (
        "import sys; sys.setrecursionlimit(10**9)\nclass A:\n def __repr__(self): return repr(self)\nrepr(A())",
        "is killed by SIG",
    ),
    "replaced": ("import os, sys; os.execv(sys.executable, [sys.executable, '-c', ''])", "exit code 0 while"),
    "alarm": ("import signal; signal.signal(14, 0); signal.raise_signal(14)", "is killed by SIGALRM"),
    "at the end": ("import atexit, os; atexit.register(os._exit, 0)", "exit code 0 when the program ends"),
    "a thread": ("import os, threading; threading.Timer(30, os._exit, [0]).start()", "leaves the thread"),
    "a daemon": (
        "import os, threading, time\nt = threading.Thread(target=lambda: (time.sleep(30), os._exit(0)), daemon=True)"
        "\nt.start()",
        "leaves the thread",
    ),
    "a timer": ("import signal; signal.setitimer(signal.ITIMER_PROF, 30)", "changes a timer of the process"),
    "fork": ("import os\nif not os.fork(): os._exit(0)", "forks the process"),
    "forks on": ("import os; os.fork()", "forks the process"),
    "division": ("1 / 0", "ZeroDivisionError: division by zero"),
    "no module": ("import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
    "syntax": ("def", "SyntaxError: invalid syntax"),
    "bytes": ("\0", "null bytes"),
    "recursion": ("def f(): f()\nf()", "RecursionError"),
    "memory": ("bytearray(1 << 62)", "MemoryError"),
    "input": ("input()", "EOFError"),
    "assertion": ("assert False, 'of its own'", "AssertionError: of its own"),
    "error without words": ("class E(Exception):\n def __str__(self): raise E\nraise E", "E"),
}
"""Those that end it."""

SPOILS = {
    "closes all": ("import os; os.closerange(0, 256)", "closes files that others have open"),
    "closes others": ("import os; os.closerange(3, 256)", "closes files that others have open"),
    "json.dumps": ("import json; json.dumps = None", "changes json.dumps"),
    "json.loads away": ("import json; del json.loads", "changes json.loads"),
    "open": ("import builtins; builtins.open = None", "changes builtins.open"),
    "len away": ("import builtins; del builtins.len", "changes builtins.len"),
    "import": ("import builtins; builtins.__import__ = lambda *a, **k: None", "changes builtins.__import__"),
    "no numpy": ("import sys; sys.modules['numpy'] = None", "the module numpy"),
    "no numpy any more": (
        "import numpy, sys; sys.modules['numpy'] = None",
        "replaces or removes the module numpy",
    ),
    "numpy away": ("import numpy, sys; del sys.modules['numpy']", "replaces or removes the module numpy"),
    "another shapely": (
        "import sys, types; sys.modules['shapely'] = types.ModuleType('shapely')",
        "module shapely",
    ),
    "no os": ("import sys; sys.modules['os'] = None", "replaces or removes the module os"),
    "array": ("import numpy; numpy.array = None", "numpy"),
    "Path.exists": ("import pathlib; pathlib.Path.exists = None", "changes pathlib.Path.exists"),
    "Path.open away": ("import pathlib; del pathlib.Path.open", "changes pathlib.Path.open"),
    "csv": ("import csv; csv.writer = None", "changes csv.writer"),
    "encoder": ("import json; json.JSONEncoder.default = None", "changes json.encoder.JSONEncoder.default"),
    "our contract": (
        "import mechwright.contracts.plugin as p; p.Plugin.fault = None",
        "contracts.plugin.Plugin.fault",
    ),
    "our host": (
        "import mechwright.plugins.host as h; h.load = None",
        "changes mechwright.plugins.host.load",
    ),
    "our error": ("import mechwright.errors as e; e.DesignError = ValueError", "changes mechwright.errors"),
    "exit": ("import sys; sys.exit = lambda *a: None", "changes sys.exit"),
    "os.replace": ("import os; os.replace = os.rename", "changes os.replace"),
    "excepthook": ("import sys; sys.excepthook = lambda *a: None", "changes sys.excepthook"),
    "trace": ("import sys; sys.settrace(lambda *a: None)", "changes the tracing function"),
    "profile": ("import sys; sys.setprofile(lambda *a: None)", "changes the profiling function"),
    "path": ("import sys; sys.path.clear()", "removes what stands in sys.path"),
    "finders": ("import sys; sys.meta_path.clear()", "sys.meta_path"),
    "path hooks": ("import sys; sys.path_hooks.clear()", "removes what stands in sys.path_hooks"),
    "open files": ("import resource as r; r.setrlimit(r.RLIMIT_NOFILE, (64, 64))", "the limit RLIMIT_NOFILE"),
    "processor time": ("import resource as r; r.setrlimit(r.RLIMIT_CPU, (90, 90))", "the limit RLIMIT_CPU"),
    "size of files": (
        "import resource as r; r.setrlimit(r.RLIMIT_FSIZE, (9**9, 9**9))",
        "limit RLIMIT_FSIZE",
    ),
    "no size of files": (
        "import resource as r; r.setrlimit(r.RLIMIT_FSIZE, (0, 0))",
        "or spoils the interpreter",
    ),
    "environment": ("import os; os.environ.clear()", "removes PATH from the environment"),
    "priority": ("import os; os.nice(5)", "changes the priority"),
    "cores": (
        "import os\nmask = sorted(os.sched_getaffinity(0))\nos.sched_setaffinity(0, mask[:1])\n"
        "if len(mask) == 1: raise OSError('changes the cores')",
        "changes the cores",
    ),
    "audits": (
        "import sys\ndef hook(event, args):\n if event == 'open': raise RuntimeError\nsys.addaudithook(hook)",
        "listens to all that Python does (sys.addaudithook)",
    ),
    "quiet audits": ("import sys; sys.addaudithook(lambda *a: None)", "sys.addaudithook"),
    "setting": (
        "import os; os.environ['MECHWRIGHT_PLUGIN_SECONDS'] = 'x'",
        "changes MECHWRIGHT_PLUGIN_SECONDS",
    ),
    "a shop": ("import os; os.environ['MECHWRIGHT_SHOP'] = '/none'", "changes MECHWRIGHT_SHOP"),
    "another system": ("import sys; sys.platform = 'win32'", "changes sys.platform"),
    "another name of the system": ("import os; os.name = 'nt'", "changes os.name"),
    "another interpreter": ("import sys; sys.executable = '/none'", "changes sys.executable"),
    "pi": ("import math; math.pi = 3", "changes math.pi"),
    "pi of numpy": ("import numpy; numpy.pi = 3.0", "changes numpy.pi"),
    "types only": ("import typing; typing.TYPE_CHECKING = True", "changes typing.TYPE_CHECKING"),
    "code": ("import json; json.dumps.__code__ = (lambda *a, **k: '').__code__", "changes json.dumps"),
    "defaults": ("import json; json.dumps.__kwdefaults__['indent'] = 7", "changes json.dumps"),
    "a method in a derived class": (
        "import pathlib; pathlib.PosixPath.read_bytes = lambda self: b''",
        "changes pathlib.PosixPath.read_bytes",
    ),
    "an attribute asked for": (
        "from mechwright.contracts.part import Part; Part.__getattribute__ = lambda s, n: 1 / 0",
        "contracts.part.Part.__getattribute__",
    ),
    "a name of Python hidden": (
        "import mechwright.reading as r; r.len = lambda x: 0",
        "hides len of Python in mechwright.reading",
    ),
    "a constant of ours": (
        "import mechwright.reading as r; r.INPUT_LIMIT = 1",
        "changes mechwright.reading.INPUT_LIMIT",
    ),
    "a field of ours": (
        "from mechwright.tolerances import TOLERANCES; object.__setattr__(TOLERANCES, 'gouge', 1.0)",
        "changes mechwright.tolerances.TOLERANCES",
    ),
    "materials": (
        "import mechwright.contracts.materials as m; m.MATERIALS.clear()",
        "contracts.materials.MATERIALS",
    ),
    "a built-in family": (
        "import mechwright_slider_crank.family as f; f.SliderCrankFamily.check = lambda s, p: []",
        "mechwright_slider_crank",
    ),
    "a finder that fails": (
        "import sys\nclass F:\n def find_spec(n, p=None, t=None):\n  if n == 'scipy': 1 / 0\nsys.meta_path.insert(0, F)",
        "keeps scipy from being imported (ZeroDivisionError)",
    ),
    "a module in the place of another": (
        "import sys, tempfile, pathlib\np = pathlib.Path(tempfile.mkdtemp()); (p / 'pyarrow.py').touch()\n"
        "sys.path.insert(0, str(p))",
        "puts another module in the place of pyarrow",
    ),
    "a place that is no text": ("import sys; sys.path.append(None)", "puts None into sys.path"),
    "kinds": ("import collections.abc; collections.abc.Mapping.register(str)", "changes kinds of types"),
    "numbers": ("import numbers; numbers.Real.register(str)", "changes kinds of types"),
}
"""Those that spoil it."""

HEALED = {
    "closes 1": "import os; os.close(1)",
    "closes 2": "import os; os.close(2)",
    "turns 2": "import os; os.dup2(os.open('/', 0), 2)",
    "closes sys.stdout": "import sys; sys.stdout.close()",
    "no sys.stdout": "import sys; sys.stdout = None",
    "changes the folder": "import os; os.chdir('/')",
    "ignores the keyboard": "import signal; signal.signal(signal.SIGINT, signal.SIG_IGN)",
    "more calls": "import sys; sys.setrecursionlimit(9000)",
    "prints garbage": "import gc; gc.set_debug(gc.DEBUG_COLLECTABLE)",
    "listens to the collector": "import gc; gc.callbacks.append(lambda *a: 1 / 0)",
    "a path at the end": "import sys; sys.path.append('/none')",
    "a finder of its own": "import sys\nclass F:\n def find_spec(n, p=None, t=None): pass\nsys.meta_path.append(F)",
    "a variable": "import os; os.environ['RODS'] = '1'",
    "a kind of its own": "import numbers\nclass N: pass\nnumbers.Real.register(N)",
}
"""What the guard sets back, and what disturbs nobody: such a plugin is used."""

FAMILY = """
from mechwright import Family, Parameters, hookimpl
class P(Parameters):
    pass
class Rude(Family[P]):
    name = title = summary = "rude"
    Params = P
    def solve(self, params, samples): raise NotImplementedError
    def parts(self, params): return []
{more}
@hookimpl
def mechwright_register():
    {first}
    return [Rude]
"""

REGISTERS = {
    "asked for anything": (
        ("def __getattribute__(self, name): 1 / 0", "pass"),
        "has a __getattribute__ of its own",
    ),
    "set": (("def __setattr__(self, *a): 1 / 0", "pass"), "has a __setattr__ of its own"),
    "compared": (("def __eq__(self, other): 1 / 0", "pass"), "of its own"),
    "made": (("def __init__(self): import os; os._exit(0)", "pass"), "exit code 0 while it is loaded"),
    "made with an error": (("def __init__(self): 1 / 0", "pass"), "Rude(): ZeroDivisionError"),
    "fault": (("@classmethod\n    def fault(cls): import os; os._exit(0)", "pass"), "exit code 0 while"),
    "derived": (("def __init_subclass__(cls): 1 / 0", "class Later(Rude): pass"), "ZeroDivisionError"),
    "hook": (("pass", "import os; os._exit(0)"), "exit code 0 while it is loaded"),
    "hook with an error": (("pass", "1 / 0"), "ZeroDivisionError"),
    "hook that spoils": (("pass", "import json; json.dumps = None"), "changes json.dumps"),
    "hook of nothing": (("pass", "return None"), "it returns nothing"),
    "no class": (("pass", "return [1, 'a']"), "is no class of a contract"),
}
"""Lines of a family and of its hook."""

WAYS = {
    **ENDS,
    **SPOILS,
    **{
        f"registered: {name}": (FAMILY.format(more=f"    {more}", first=first), said)
        for name, ((more, first), said) in REGISTERS.items()
    },
}
