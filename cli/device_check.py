"""Looks at the devices of `robot=...`: they are read, nothing is told to move."""

import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np

from cli.build import Bench, Config
from cli.findings import FAIL, Finding, Suspicious, look
from imitation.device import DeviceError
from imitation.robot import SECOND, Arm, Observation, Shot
from imitation.robots.katana.arm import KatanaArm
from imitation.robots.katana.commands import Status
from imitation.robots.serial_line import SerialLine
from imitation.robots.servo_arm import ServoArm
from imitation.robots.ssc32 import board_version, pulses_at

SERIAL = ("ttyS[0-9]", "ttyUSB*", "ttyACM*")
WATCH = 1.0  # how long the camera is watched [s]
NEARLY = 10  # so near to where it gives up a servo is too warm [degrees Celsius]
DARK, BRIGHT = 30, 225  # mean brightness of a picture that can be seen on


def device_findings(cfg: Config) -> Iterator[Finding]:
    """What is found of the arm, its camera and its neck."""
    yield look("ports", _ports)
    bench = Bench({**cfg, "neck": None})
    try:
        yield from _of_arm(bench)
        yield look("camera", lambda: _camera(bench), device=True)
        yield look("neck", lambda: _neck(cfg), device=True)
    finally:
        bench.close()


def _of_arm(bench: Bench) -> Iterator[Finding]:
    made = look("arm", lambda: _arm(bench), device=True)
    yield made
    if made.verdict == FAIL:
        return
    arm = bench.arm
    if not arm.live:
        arm.reset(bench.guided.mean(axis=0))
    yield look("joints", lambda: _joints(arm), device=True)
    if isinstance(arm, KatanaArm):
        yield look("motors", lambda: _motors(arm, bench.cfg), device=True)
        yield look("gripper", lambda: _gripper(arm), device=True)
    if isinstance(arm, ServoArm):
        yield look("servos", lambda: _servos(arm), device=True)


def _ports() -> str:
    found = sorted(str(path) for name in SERIAL for path in Path("/dev").glob(name))
    cameras = sorted(str(path) for path in Path("/dev").glob("video*"))
    return (
        f"serial: {', '.join(found) or 'none'} (robot.arm.address=PORT, neck.port=PORT); "
        f"cameras: {', '.join(cameras) or 'none'} (camera.device=DEVICE)"
    )


def _arm(bench: Bench) -> str:
    arm = bench.arm
    if not isinstance(arm, KatanaArm):
        return f"{arm.body.name}, {'real' if arm.live else 'simulated'}"
    major, minor = arm.identity.firmware
    return f"{arm.identity.text}, firmware {major}.{minor}, model {arm.katana.model.name}"


def _joints(arm: Arm) -> str:
    posture, body = arm.read().posture, arm.body
    angles, lower, upper = np.degrees((posture, body.lower, body.upper))
    told = ", ".join(
        f"{at:.0f}° ({least:.0f}..{most:.0f})"
        for at, least, most in zip(angles, lower, upper, strict=True)
    )
    beyond = (posture < body.lower) | (posture > body.upper)
    if beyond.any():
        joint = int(np.argmax(beyond))
        raise Suspicious(
            f"{told}: {body.joint_names[joint]} is beyond its limits; calibrate the arm"
        )
    return told


def _motors(arm: KatanaArm, cfg: Config) -> str:
    began, calls = time.monotonic(), 5
    for _ in range(calls):
        statuses = arm.katana.statuses()
    each = (time.monotonic() - began) / calls
    told = f"status {' '.join(map(str, statuses))}, {1000 * each:.0f} ms a call"
    driving = cfg["robot"]["arm"]["driving"]
    # A run that is told so puts them right; every other one ends with exit code 3.
    mended = driving["calibrate"] or driving["unblock"]
    trouble = Suspicious if mended else DeviceError
    if Status.CRASHED in statuses:
        raise trouble(f"{told}: one has collided; free it, robot.arm.driving.unblock=true")
    if Status.OFF in statuses:
        raise trouble(f"{told}: off; type robot.arm.driving.calibrate=true or .unblock=true")
    return told


def _gripper(arm: KatanaArm) -> str:
    return f"sensors {' '.join(map(str, arm.katana.sensors()))}"


def _servos(arm: ServoArm) -> str:
    arm.bus.refuse_troubled()
    found = arm.bus.report()
    hottest = int(np.argmax(found.temperature - found.hottest))
    told = (
        f"firmware {', '.join(sorted(set(found.firmware)))}, "
        f"{found.voltage.min():.1f} to {found.voltage.max():.1f} V, "
        f"up to {found.temperature[hottest]:.0f} of {found.hottest[hottest]:.0f} °C, "
        f"torque {'on' if found.torque_on.all() else 'off'}, "
        f"limited to {100 * found.torque_limit.max():.0f} %"
    )
    if found.temperature[hottest] > found.hottest[hottest] - NEARLY:
        name = (*arm.body.joint_names, "the jaw")[hottest]
        raise Suspicious(f"{told}: let {name} cool")
    return told


def _camera(bench: Bench) -> str:
    camera = bench.camera
    if not camera.live:
        seen = bench.perception(bench.field).perceive(bench.robot.reset()).hand
        return "simulated" + ("" if seen is None else f", hand at {_place(seen)}")
    camera.reset(0)
    began, frames = time.monotonic(), 0
    while (passed := time.monotonic() - began) < WATCH:
        shot = camera.look(round(passed * SECOND), None)
        frames += 1 + len(shot.skipped)
        time.sleep(0.1)
    rate, bright = frames / WATCH, float(shot.frame.mean())
    pixels = bench.perception(bench.field).detector.hand_in(_seen(shot))
    ends = float(np.isin(shot.frame, (0, 255)).all(axis=2).mean())
    told = (
        f"{rate:.0f} frames/s, brightness {bright:.0f} of 255, "
        f"{100 * ends:.0f} % of it black or white"
    )
    if not DARK <= bright <= BRIGHT:
        raise Suspicious(f"{told}: set its exposure, or the light")
    if not len(pixels):
        raise Suspicious(f"{told}, no hand in view: look at vision.hue, vision.saturation")
    return f"{told}, {len(pixels)} px of the hand's colour at {_place(pixels.mean(axis=0))}"


def _seen(shot: Shot) -> Observation:
    """A frame as a detector wants it; of the arm it asks nothing."""
    return Observation(
        time_ns=shot.time_ns,
        posture=np.zeros(0),
        velocity=np.zeros(0),
        gaze=shot.gaze,
        frame=shot.frame,
        frame_time_ns=shot.time_ns,
        frame_gaze=shot.gaze,
        place_noise=shot.place_noise,
        opening=1.0,
        proximity=float("inf"),
        touching=False,
    )


def _place(place: object) -> str:
    x, y = np.asarray(place)
    return f"[{x:.0f}, {y:.0f}] px"


def _neck(cfg: Config) -> str:
    node = cfg.get("neck")
    if not node:
        return "none asked for (neck=ssc32)"
    line = SerialLine(node["port"], node["baud"], node["timeout"])
    with closing(line):
        version = board_version(line, node["timeout"])
        channels = [node[axis]["channel"] for axis in ("pan", "tilt")]
        pan, tilt = pulses_at(line, channels, node["timeout"])
    return f"{version}, pulses of pan {pan} us, of tilt {tilt} us (0: not told yet)"
