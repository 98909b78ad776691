"""What devlearn refuses, and how it says so."""

from __future__ import annotations


class InvalidValue(ValueError):  # noqa: N818 - it names the value, as C++ does
    """A value or a call that devlearn refuses; the object that refused is left as it was.

    Attributes
    ----------
    quantity : str
        Which quantity, such as ``LearnerConfig.sigma``.
    value : str
        What was given.
    allowed : str
        What is allowed.
    """

    def __init__(self, quantity: str, value: object, allowed: str) -> None:
        super().__init__(quantity, str(value), allowed)
        self.quantity = quantity
        self.value = str(value)
        self.allowed = allowed

    def __str__(self) -> str:
        return f"{self.quantity}: got {self.value}; expected {self.allowed}"


class WrongType(InvalidValue, TypeError):  # noqa: N818 - likewise
    """The same for an argument of a wrong type, or a call with arguments that there are not."""


class FileError(InvalidValue, OSError):
    """The same for a file: it also says which file and, where there is one, which field.

    Attributes
    ----------
    file : str
        Path of the file, or what stands for it.
    field : str
        Path of the field within the file, such as ``obstacles[2].radius``; empty for the whole.
    """

    def __init__(self, file: str, field: str, value: object, allowed: str) -> None:
        OSError.__init__(self)  # it would take these for an errno and its text
        self.args = (file, field, str(value), allowed)
        self.filename = file
        self.quantity = field
        self.value = str(value)
        self.allowed = allowed
        self.file = file
        self.field = field

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), self.args

    def __str__(self) -> str:
        where = f"{self.file}: {self.field}" if self.field else self.file
        return f"{where}: got {self.value}; expected {self.allowed}"


class MissingExtra(ImportError):
    """A part of devlearn needs a package of an extra that is not installed; it says how to get it.

    Parameters: what needs it, the package, the extra of ``pyproject.toml`` that brings it.
    """

    def __init__(self, what: str, package: str, extra: str) -> None:
        import shlex
        import sys
        from importlib.metadata import requires  # which takes 25 ms

        of_extra = f'extra == "{extra}"'
        needed = [
            requirement.replace(of_extra, "").removesuffix(" and ").rstrip("; ")
            for requirement in (text.replace("'", '"') for text in requires("devlearn") or ())
            if requirement.endswith(of_extra)
        ]
        command = shlex.join([sys.executable, "-m", "pip", "install", *(needed or [package])])
        super().__init__(
            f"{what} needs {package}, which is not installed; to have it: {command}",
            name=package,
        )
