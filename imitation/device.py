"""What a device cannot do for us."""


class DeviceError(RuntimeError):
    """A device failed; its text is one sentence for people: what was wanted, what came, what to do.

    The run ends with exit code 3 and its recording is readable.
    """
