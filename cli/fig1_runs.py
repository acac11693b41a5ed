"""What Fig. 1 needs before it is drawn: a portrait of the robot, its hand seen many times."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from cli.build import Bench, generator
from cli.every_seed import on_every_seed
from cli.experiments import Experiment
from imitation.analysis.fig1 import HandInView, Scene, Sightings, draw_fig1
from imitation.analysis.figure_style import Drawn
from imitation.arrays import Array
from imitation.robots.bullet.world import find_urdf
from imitation.robots.kinematic_chain import KinematicChain


@dataclass(frozen=True)
class Fig1:
    """Runs and drawing of Fig. 1; its YAML says what each means."""

    experiment: Experiment
    postures: int
    dense: int
    portrait: Any  # of imitation.robots
    drawing: HandInView


def fig1(seeds: Sequence[int], settings: Fig1) -> Drawn:
    """Run and draw Fig. 1."""
    experiment = settings.experiment
    work = partial(sightings, experiment=experiment, count=settings.postures)
    seen = on_every_seed("fig1", work, seeds, experiment.workers)
    with experiment.learning_bench(seeds[0]) as bench:
        scene = scene_of(bench, settings.portrait)
        places = projections(bench, hull(seeds[0], bench, settings.dense, "coverage"))
        return draw_fig1(scene, bench.field, seen, places, settings.drawing)


def hull(seed: int, bench: Bench, count: int, purpose: str) -> Array:
    """Random postures of the exploration hull, (count, n_joints) [rad]."""
    guided = bench.guided
    return np.asarray(generator(seed, purpose).dirichlet(np.ones(len(guided)), count) @ guided)


def sightings(seed: int, experiment: Experiment, count: int) -> Sightings:
    """Where the hand truly is and where it is seen, at random postures of the hull."""
    true, seen = [], []
    with experiment.learning_bench(seed) as bench:
        perception = bench.perception(bench.field)
        for posture in hull(seed, bench, count, "sightings"):
            percept = perception.perceive(bench.robot.reset(posture))
            true.append(bench.robot.truth()[-1].hand_px)
            seen.append(np.full(2, np.nan) if percept.hand is None else percept.hand)
    return Sightings(np.array(true), np.array(seen))


def projections(bench: Bench, postures: Array) -> Array:
    """Where the mark on the hand lies in visual space at each of `postures`, (n, 2) [px]."""
    arm, eye = bench.cfg["robot"]["arm"], np.array(bench.cfg["camera"]["eye"])
    mark = (arm["mark"]["link"], np.array(arm["mark"]["offset"]))
    chain = KinematicChain(
        find_urdf(arm["urdf"]), tuple(arm["joints"]), [mark], np.array(arm["base"])
    )
    return np.array([bench.space.project(chain.positions(posture)[0], eye) for posture in postures])


def scene_of(bench: Bench, portrait: Any) -> Scene:
    """The robot at the middle of its hull, from the side and as its own camera sees it."""
    camera, world = bench.cfg["camera"], bench.robot.arm.world  # type: ignore[attr-defined]
    eye, gaze = np.array(camera["eye"]), np.array(camera["gaze"])
    seen = bench.robot.reset()
    hand = bench.perception(bench.field).perceive(seen).hand
    mark = bench.robot.truth()[-1].hand_m
    base = np.array(bench.cfg["robot"]["arm"]["base"])
    height = world.table.height
    width, tall = bench.space.size
    corners = np.array(((0, 0), (width, 0), (width, tall), (0, tall)))
    view = [portrait.place_of(bench.space.unproject(corner, eye, height)) for corner in corners]
    return Scene(
        side=portrait.picture(world, seen.posture, eye, gaze),
        frame=seen.frame,
        hand=np.full(2, np.nan) if hand is None else hand,
        camera=portrait.place_of(eye),
        base=portrait.place_of(base + np.array((0.0, 0.0, 0.10))),
        mark=portrait.place_of(mark),
        view=np.array(view),
        joints=len(seen.posture),
    )
