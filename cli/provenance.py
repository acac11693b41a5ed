"""Which code, packages and inputs a run was made with."""

import hashlib
import json
import platform
import subprocess
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

PACKAGE = "emergent-imitation-bench"
PACKAGES = ("numpy", "opencv-python-headless", "pybullet", "mcap", "rosbags", "hydra-core")


def program_version() -> str:
    """The version of this program."""
    try:
        return version(PACKAGE)
    except PackageNotFoundError:
        return "unknown"


def run_record(command: str, seed: int, robot: str) -> dict[str, str]:
    """The recording's metadata record `run`."""
    revision, dirty = _git()
    packages = {name: version(name) for name in PACKAGES}
    packages["python"] = platform.python_version()
    return {
        "command": command,
        "version": program_version(),
        "git_revision": revision,
        "git_dirty": dirty,
        "seed": str(seed),
        "robot": robot,
        "packages": json.dumps(packages, sort_keys=True),
    }


def another_program(wrote: Mapping[str, str]) -> str:
    """Which program wrote a recording, and which this is; empty when they are the same.

    Args:
        wrote: The recording's record `run`.
    """
    here = run_record(wrote.get("command", ""), 0, "")
    keys = ("version", "git_revision", "git_dirty")
    if all(wrote.get(key, "") == here[key] for key in keys):
        return ""
    return f"it was recorded by {_program(wrote)}, this is {_program(here)}"


def its_program(wrote: Mapping[str, str]) -> str:
    """How to get the program that wrote a recording."""
    if revision := wrote.get("git_revision"):
        return f"git checkout {revision[:12]}"
    return f"pip install {PACKAGE}=={wrote.get('version', '?')}"


def _program(record: Mapping[str, str]) -> str:
    changed = " with changes" if record.get("git_dirty") == "true" else ""
    revision = record.get("git_revision", "")[:12]
    return f"version {record.get('version', '?')}{f' at {revision}' * bool(revision)}{changed}"


def sha256(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _git() -> tuple[str, str]:
    """Revision and whether it was changed since; both empty outside this package's checkout."""
    checkout = Path(__file__).parents[1]
    if not (checkout / ".git").exists():
        return "", ""
    try:
        revision = _ask_git(checkout, "rev-parse", "HEAD")
        changed = _ask_git(checkout, "status", "--porcelain", "--untracked-files=no")
    except (OSError, subprocess.SubprocessError):
        return "", ""
    return revision, "true" if changed else "false"


def _ask_git(checkout: Path, *words: str) -> str:
    call = ["git", "-C", str(checkout), *words]
    answer = subprocess.run(call, capture_output=True, text=True, timeout=10, check=True)
    return answer.stdout.strip()
