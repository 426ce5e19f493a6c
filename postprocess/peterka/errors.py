"""What is raised for users: one class for all that is peterka's own, one for a job, one for a file."""


class PeterkaError(Exception):
    """The program could not do what it was asked for; the message is its own."""


class JobError(PeterkaError):
    """A job with faults: `faults` has all of them, one text each, with line and column where they have one."""

    def __init__(self, faults: list[str]) -> None:
        super().__init__("\n".join(faults))
        self.faults = faults


class PeterkaFileError(PeterkaError):
    """The file is not one of peterka's, is damaged or unfinished, or has not what is asked for; the message says so in one line."""
