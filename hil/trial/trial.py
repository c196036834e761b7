"""One run of a rig under a schedule of faults: the whole of it, from power-up to a verdict."""

from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from hashlib import sha256
from typing import Final, NamedTuple

from controller.action import Policy
from controller.outcome import Outcome
from controller.settings import Plan
from drivers.errors import DriverError
from drivers.interfaces import SensorHealth
from hil.app.faulty import events
from hil.app.host_faults import HostFaultError, HostFaults, split
from hil.app.inline import InlineCell
from hil.app.learner_faults import FaultyPolicy, Pieces
from hil.app.near import near_side, part_named, start_plan
from hil.app.policy import policy as named_policy
from hil.cell.errors import CellError
from hil.cell.faults.log import FaultEvent, idle
from hil.cell.faults.schedule import Numbered, Schedule
from hil.cell.injection.places import OF_A_RUN
from hil.cell.rig import Rig
from hil.recording.channels.event import portless
from hil.trial import recovery
from hil.trial.disk import recording
from hil.trial.drive import Driven, Driver
from hil.trial.figures import Figures, figures
from hil.trial.fmea import load
from hil.trial.owed import Owed
from hil.trial.sampler import Sampler
from hil.trial.trace import Trace
from hil.trial.verdict import Judgement, Verdict, Violation
from learner.episode import Episode
from learner.interface import Learner

NS: Final = 1_000_000_000
LONGEST: Final = 120.0
"""Bench seconds of a run; an insertion takes 10 to 60."""
PATIENCE: Final = 15.0
"""Wall s of silence on a link that are no dead link: campaigns share their machine."""
SCRIPTED: Final = ("pose", "spiral", "random", "oracle")
"""Policies by name; every other name is a learner's."""
AFTERMATH: Final = 1.5
"""Bench seconds from the host's last command to the end of a run: longer than any stop may take,
and than the cell goes on by itself after a cut link, so that every run ends at its own time."""


@dataclass(frozen=True)
class Trial:
    """verdict, reason: the run's. outcome: the job's own, None where it never ended by itself.

    robustness: of each always-on monitor, in scales. events: what became of each fault. log: the
    robot's, (bench ns, text). digest: SHA-256 of all of it; the same run has the same one.
    """

    seed: int
    schedule: Schedule | None
    verdict: Verdict
    reason: str
    outcome: Outcome | None
    error: str
    trace: Trace
    events: tuple[FaultEvent, ...]
    faults: tuple[Figures, ...]
    robustness: dict[str, float]
    violations: tuple[Violation, ...]
    health: SensorHealth | None
    log: tuple[tuple[int, str], ...] = field(repr=False)
    period: int

    @property
    def worst(self) -> float:
        """Least robustness of all always-on monitors."""
        return min(self.robustness.values(), default=float("inf"))

    @property
    def digest(self) -> str:
        told = f"{self.verdict}\0{self.reason}\0{self.outcome}\0{self.error}\0"
        hashed = sha256(portless(told).encode())
        hashed.update(self.trace.digest.encode())
        for event in self.events:
            hashed.update(f"{event.t} {event}\0".encode())
        return hashed.hexdigest()


def run_trial(
    rig: Rig,
    seed: int,
    schedule: Schedule | None = None,
    *,
    policy: "str | Policy" = "pose",
    part: str = "",
    longest: float = LONGEST,
    back: bool = True,
) -> Trial:
    """Serve the rig's cell in this process in lockstep, drive one assembly, judge it.

    policy: a name as of `hil run` or of a learner, or a policy of one's own. longest: bench s that
    are no hang. back: whether the near side is brought up again after the run, where the FMEA wants
    it to come back from a fault. Raises RigError, FaultError and UnknownLearnerError for what
    cannot be run at all, and nothing else.
    """
    plan = start_plan(rig, part_named(rig, part or rig.first_part), seed)
    driver = Driver(rig, sampler := Sampler(rig), round(longest * NS))
    ran = _Run(rig, seed, schedule, policy, plan, back).drive(driver, sampler)
    judgement = sampler.judge.judgement
    verdict, reason = _verdict(ran.driven, ran.died, judgement, ran.events)
    return Trial(
        seed=seed,
        schedule=schedule,
        verdict=verdict,
        reason=reason,
        outcome=ran.driven.outcome,
        error=_words(ran.driven.error),
        trace=sampler.trace,
        events=ran.events,
        faults=figures(
            sampler.trace,
            ran.events,
            sampler.noticed,
            ran.recovered,
            broken_off=ran.driven.broken_off,
        ),
        robustness=judgement.robustness,
        violations=judgement.violations,
        health=ran.health,
        log=ran.log,
        period=rig.robot.period,
    )


class _Ran(NamedTuple):
    """What happened, before anybody judges it. died: what the cell ended of, if it did."""

    driven: Driven
    died: BaseException | None
    events: tuple[FaultEvent, ...]
    health: SensorHealth
    log: tuple[tuple[int, str], ...]
    recovered: dict[int, float]


class _Run(NamedTuple):
    """A cell and a near side that are brought up, broken, driven and taken down."""

    rig: Rig
    seed: int
    schedule: Schedule | None
    policy: "str | Policy"
    plan: Plan
    back: bool

    def drive(self, driver: Driver, sampler: Sampler) -> _Ran:
        rig, seed = self.rig, self.seed
        learner = _learner(self.policy, rig, seed)
        with ExitStack() as stack:
            far, host = _faults(rig, seed, self.schedule, learner, stack)
            opened = InlineCell(rig, seed, "lockstep", faults=far, observe=sampler.tick)
            cell = stack.enter_context(opened)
            sampler.bench = cell.served.bench
            with near_side(rig, cell.doors, driver.heard, PATIENCE) as near:
                chosen = _chooser(self.policy, learner, self.plan, seed, cell)
                if host is not None:
                    chosen = FaultyPolicy(chosen, host, _pieces(learner, host))
                    self._arm(driver, sampler, cell, host, stack)
                driven = driver.run(near, self.plan, chosen)
                health = near.sensor.health
            died = _aftermath(cell, rig, sampler.answered + round(AFTERMATH * NS))
            if host is not None:
                host.news()
            told = events(cell.served) + (host.events if host is not None else ())
            log = cell.served.bench.arm.log
            sampler.bench = None  # the run is over
            recovered = self._recover(cell, told) if died is None and self.back else {}
        happened = tuple(sorted(told, key=lambda event: event.t))
        return _Ran(driven, died, happened, health, log, recovered)

    def _recover(self, cell: InlineCell, told: tuple[FaultEvent, ...]) -> dict[int, float]:
        """How long the way back took, by the index of each fault that wants one."""
        numbered = () if self.schedule is None else self.schedule.numbered(self.seed)
        faults = recovery.wanted(numbered, told, load())
        seconds = recovery.recover(cell, self.rig, PATIENCE) if faults else None
        return {} if seconds is None else dict.fromkeys(faults, seconds)

    def _arm(
        self,
        driver: Driver,
        sampler: Sampler,
        cell: InlineCell,
        host: HostFaults,
        stack: ExitStack,
    ) -> None:
        """Faults of the near side's process act from here on, and what each is owed is watched."""
        schedule = self.schedule
        assert schedule is not None, "faults come from a schedule"
        logs = partial(events, cell.served), lambda: host.events
        sampler.faults = Owed(schedule.numbered(self.seed), load(), *logs)
        driver.attend = lambda cycle, course, arm: host.attend(cycle, course, cell, arm)
        if any(fault.kind == "H4" for fault in schedule.faults):
            driver.record = recording(self.rig, self.seed, cell, host, stack)


def _learner(policy: "str | Policy", rig: Rig, seed: int) -> Learner | None:
    """The learner of that name, None of a scripted policy or one of one's own."""
    if not isinstance(policy, str) or policy in SCRIPTED:
        return None
    from hil.trial.learnt import learnt  # noqa: PLC0415  learners compile their rules

    return learnt(policy, rig, seed)


def _chooser(
    policy: "str | Policy", learner: Learner | None, plan: Plan, seed: int, cell: InlineCell
) -> Policy:
    if learner is not None:
        return Episode(learner)
    return named_policy(policy, plan, seed, cell) if isinstance(policy, str) else policy


def _faults(
    rig: Rig, seed: int, schedule: Schedule | None, learner: Learner | None, stack: ExitStack
) -> tuple[Numbered | None, HostFaults | None]:
    """The cell's faults and those of the near side's process."""
    if schedule is None:
        return None, None
    where = OF_A_RUN
    if learner is not None:
        from hil.app.agent_faults import places  # noqa: PLC0415  learners compile their rules

        where = places(learner)
    far, near = split(schedule.numbered(seed), rig, recorded=True, places=where)
    return far, stack.enter_context(HostFaults(near, seed, rig.robot.period, "lockstep"))


def _pieces(learner: Learner | None, host: HostFaults) -> Pieces | None:
    """What of the learner may fail."""
    if learner is None:
        return None
    from hil.app.agent_faults import pieces  # noqa: PLC0415  learners compile their rules

    return pieces(learner, host)


def _aftermath(cell: InlineCell, rig: Rig, until: int) -> BaseException | None:
    """Watch the cell without its host until then, ns; what it died of, if it did."""
    try:
        cell.coast(0)  # its own clock stands from here on
        cell.coast(max(0, until - cell.served.bench.t) // rig.robot.period)
    except Exception as error:  # whatever it is, the run is over and this is why
        return error
    return None


def _verdict(
    driven: Driven,
    died: BaseException | None,
    judgement: Judgement,
    events: tuple[FaultEvent, ...],
) -> tuple[Verdict, str]:
    """The gravest first: what crashed cannot be judged, what is unsafe need not be proven."""
    wild = driven.error is not None and not isinstance(driven.error, DriverError | CellError)
    killed = isinstance(driven.error, HostFaultError)
    waiting = ", ".join(kind for _, kind in idle(events))
    ended = driven.outcome
    found = (
        (died is not None, Verdict.CRASH, f"the cell: {_words(died)}"),
        (wild, Verdict.CRASH, f"the near side: {_words(driven.error)}"),
        (judgement.violations, Verdict.FAILED, "; ".join(map(str, judgement.violations))),
        (driven.overtime, Verdict.HANG, "the job did not end within its bench time"),
        (waiting, Verdict.VACUOUS, f"armed, but without any effect: {waiting}"),
        (killed, Verdict.PASSED, f"{driven.error}: the robot stood without its host"),
        (ended is None, Verdict.BLOCKED, _words(driven.error)),
    )
    for holds, verdict, reason in found:
        if holds:
            return verdict, reason
    assert ended is not None, "else it is blocked"
    return Verdict.PASSED, f"{ended.kind.value}: {ended.reason}"


def _words(error: BaseException | None) -> str:
    return "" if error is None else f"{type(error).__name__}: {error}"
