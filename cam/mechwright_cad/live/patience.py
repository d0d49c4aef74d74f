"""Connections that are not kept for clients that say nothing, or half a question."""

import asyncio

from uvicorn.protocols.http.h11_impl import H11Protocol

PATIENCE = 10.0
"""Seconds within which a question has to be here: it comes from this machine, and is short."""
MANY = 64
"""Connections at a time: a browser has six to a server, and a second page is a second one."""


class Impatient(H11Protocol):
    """Closes a connection on which no whole head of a request comes within ``PATIENCE``.

    Connections that the server keeps after an answer are closed when they are silent; half a head would keep
    one for ever. A client has as long to read an answer that fills the system's buffers, and a connection on
    which the next question comes before the answer is closed with that answer: no browser asks so, and a row
    of questions for news would keep the connection for hours.
    """

    _unread: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A connection is there."""
        super().connection_made(transport)
        self._wait()

    def on_response_complete(self) -> None:
        """An answer is out, and the next question may come."""
        if self.conn.trailing_data[0]:
            self.transport.close()
        super().on_response_complete()
        self._wait()

    def pause_writing(self) -> None:
        """The client does not read."""
        super().pause_writing()
        self._unread = self.loop.call_later(PATIENCE, self.transport.abort)

    def resume_writing(self) -> None:
        """The client has read."""
        if self._unread is not None:
            self._unread.cancel()
            self._unread = None
        super().resume_writing()

    def _wait(self) -> None:
        self.loop.call_later(PATIENCE, self._look, self.cycle)

    def _look(self, before: object) -> None:
        if self.cycle is not before:
            return
        if self.transport.get_write_buffer_size():
            self.transport.abort()  # to close would wait until the client has read the rest
        elif not self.transport.is_closing():
            self.transport.close()
