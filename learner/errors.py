"""What can go wrong with a learner, its checkpoints and its companions."""


class LearnerError(Exception):
    """Root of this package's errors."""


class CheckpointError(LearnerError):
    """A checkpoint that is damaged, of another kind, or of another version."""


class UnknownLearnerError(LearnerError):
    """A name that is neither a learner of this package nor an import path of one."""


class LearnerParameterError(LearnerError):
    """A parameter that a learner does not have, or a value that it refuses."""


class MissingExtraError(LearnerError):
    """A learner that needs packages which are not installed."""


class RingGapError(LearnerError):
    """Transitions were overwritten before the learner took them: its experience has a hole."""


class LearnerGoneError(LearnerError):
    """The learner's process ended by itself."""


class UnknownWorldError(LearnerError):
    """A name that is no world of this package."""
