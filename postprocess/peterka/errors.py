"""Exceptions raised for users: the base class PeterkaError, and one each for jobs and files."""


class PeterkaError(Exception):
    """The program could not do what was requested; the message is the program's own."""


class JobError(PeterkaError):
    """A faulty job: `faults` lists all faults, one text each, with line and column if known."""

    def __init__(self, faults: list[str]) -> None:
        super().__init__("\n".join(faults))
        self.faults = faults


class PeterkaFileError(PeterkaError):
    """The file is not one of peterka's, is damaged or incomplete, or lacks what was requested; the message is one line."""
