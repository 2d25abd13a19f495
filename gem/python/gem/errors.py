"""The exceptions and the warning of the package."""


class GemError(Exception):
    """A file cannot be read, or a call makes no sense. The text says problem, reason and suggestion."""


class ProgramError(GemError):
    """The program gem ended with an error.

    Attributes: `exit_code` as in the user guide (negative: killed by that signal), `message` without the program's name.
    """

    def __init__(self, message: str, exit_code: int):
        super().__init__(f"{message} (exit code {exit_code} of gem)")
        self.message = message
        self.exit_code = exit_code


class GemWarning(UserWarning):
    """A warning of the program, e.g. that the verdict on a run is bad."""
