"""The force/torque sensor on its TCP protocol, as drivers.interfaces.ForceTorqueSensor."""

from drivers.errors import ProtocolError
from drivers.interfaces import SensorHealth, WrenchReading
from drivers.nrs.plausibility import TYPICAL, Plausible
from drivers.nrs.stream import Stream
from drivers.nrs.tcp_session import NRS_6050_D80, Range, TcpSession
from drivers.protocol.nrs_tcp import PORT


class TcpSensor:
    """Takes the stream in the caller's thread, so that lockstep runs repeat.

    max_age_ns: limit on the newest sample's age in arm time. period_ns: time between samples,
    whole milliseconds. rated: beyond it, a sample is an overload.
    """

    def __init__(
        self,
        host: str,
        port: int = PORT,
        *,
        max_age_ns: int = 10_000_000,
        period_ns: int = 1_000_000,
        rated: Range = NRS_6050_D80,
        plausible: Plausible = TYPICAL,
    ) -> None:
        self._stream = Stream(host, port)
        self._session = TcpSession(period_ns, max_age_ns, rated, plausible)

    def connect(self) -> None:
        """Open the stream; raises LinkError."""
        self._stream.open()
        self._session.connected()

    def close(self) -> None:
        self._stream.close()

    def start(self) -> None:
        """Ask the sensor to stream at the driver's rate; its zero is its own until a tare."""
        self._session.start()

    @property
    def ready(self) -> bool:
        return self._session.ready

    def begin_tare(self, samples: int) -> None:
        """Ask the sensor to zero itself, then take off the mean of so many samples of the rest."""
        self._session.begin_tare(samples)

    @property
    def tare_pending(self) -> bool:
        return self._session.tare_pending

    def poll(self, t: int) -> None:
        """Take what is here at arm time t; raises LinkError, ProtocolError, CommandRefusedError."""
        try:
            self._session.take(self._stream.take(), t)
        except ProtocolError:
            self._stream.close()  # a stream that broke the protocol once cannot be trusted again
            raise
        request = self._session.due(t)
        if request:
            self._stream.send(request)

    def read(self, t: int) -> WrenchReading:
        """Poll, then the newest wrench; raises what poll raises, and SensorError for no wrench."""
        self.poll(t)
        return self._session.reading(t)

    @property
    def health(self) -> SensorHealth:
        """Counts since construction; a stream repeats and tears nothing."""
        session = self._session
        return SensorHealth(
            pairs=session.received,
            gaps=session.gaps,
            duplicates=0,
            torn=0,
            malformed=session.malformed,
            foreign=session.foreign,
            receiver_alive=self._stream.is_open,
            last_error=session.last_error,
        )
