"""Recordings as a LeRobot dataset, version 3: frames, postures and the commands that were sent."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]

from imitation.analysis.running_statistics import Statistics
from imitation.recording.json_file import write_json
from imitation.recording.mcap_recording import Recording
from imitation.recording.recorded_steps import StepTold, steps_told
from imitation.robot import SECOND

STATE, ACTION, CAMERA = "observation.state", "action", "observation.images.camera"
COUNTED = ("frame_index", "episode_index", "index", "task_index")
DATA = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
CHUNK = 1000  # files in a folder
EPISODES = "meta/episodes/chunk-000/file-000.parquet"


class Dataset:
    """Writes a dataset, an episode a file.

    Args:
        folder: Where; must be empty.
        period_ns: Control period [ns].
        robot: Name of the arm.
        joints: Names of its joints.
    """

    def __init__(self, folder: Path, period_ns: int, robot: str, joints: Sequence[str]) -> None:
        self._folder, self._period_ns, self._robot = folder, period_ns, robot
        self._joints, self._size = list(joints), (0, 0)  # of the frames, height and width [px]
        self._episodes: list[dict[str, Any]] = []
        self._tasks: list[str] = []
        self._statistics = {name: Statistics() for name in (STATE, ACTION, CAMERA, "timestamp")}

    def add(self, recording: Recording) -> None:
        """Add the episodes of a run.

        Raises:
            ValueError: The recording is damaged, or of another arm or camera.
        """
        if list(recording.topics["/joint_states"].names) != self._joints:
            raise ValueError(f"{recording.path} is of another arm: it has other joints")
        task = f"imitate {recording.metadata['run'].get('command', '')}"
        for steps in _episodes(recording):
            self._add_episode(task, steps)

    def finish(self) -> None:
        """Write what tells of the whole dataset."""
        meta = self._folder / "meta"
        write_json(meta / "info.json", self._info())
        shapes = {STATE: (-1,), ACTION: (-1,), CAMERA: (3, 1, 1), "timestamp": (1,)}
        told = {name: one.told(shapes[name]) for name, one in self._statistics.items()}
        write_json(meta / "stats.json", told)
        pq.write_table(_tasks(self._tasks), meta / "tasks.parquet")
        pq.write_table(pa.Table.from_pylist(self._episodes), self._folder / EPISODES)

    def _add_episode(self, task: str, steps: Sequence[StepTold]) -> None:
        if task not in self._tasks:
            self._tasks.append(task)
        number, first = len(self._episodes), sum(one["length"] for one in self._episodes)
        chunk, file = divmod(number, CHUNK)  # LeRobot reads the files in the order of their names
        data = self._folder / DATA.format(chunk_index=chunk, file_index=file)
        for folder in (data.parent, (self._folder / EPISODES).parent):
            folder.mkdir(parents=True, exist_ok=True)
        table = self._table(steps, number, first, self._tasks.index(task))
        pq.write_table(table, data, row_group_size=len(steps))
        self._episodes.append(
            {
                "episode_index": number,
                "tasks": [task],
                "length": len(steps),
                "dataset_from_index": first,
                "dataset_to_index": first + len(steps),
                "data/chunk_index": chunk,
                "data/file_index": file,
                "meta/episodes/chunk_index": 0,
                "meta/episodes/file_index": 0,
            }
        )

    def _table(self, steps: Sequence[StepTold], episode: int, first: int, task: int) -> Any:
        state = np.array([one.step.seen.posture for one in steps], dtype=np.float32)
        action = np.array([one.step.sent for one in steps], dtype=np.float32)
        times = np.array([one.time_ns - steps[0].time_ns for one in steps]) / SECOND
        for name, values in ((STATE, state), (ACTION, action), ("timestamp", times[:, None])):
            self._statistics[name].add(np.asarray(values, dtype=float))
        count = np.arange(len(steps))
        vector = pa.list_(pa.float32(), len(self._joints))
        return pa.table(
            {
                CAMERA: pa.array([self._picture(one) for one in steps], PICTURE),
                STATE: pa.FixedSizeListArray.from_arrays(state.ravel(), type=vector),
                ACTION: pa.FixedSizeListArray.from_arrays(action.ravel(), type=vector),
                "timestamp": pa.array(times.astype(np.float32)),
                "frame_index": count,
                "episode_index": np.full(len(steps), episode),
                "index": first + count,
                "task_index": np.full(len(steps), task),
            }
        )

    def _picture(self, told: StepTold) -> dict[str, Any]:
        frame = told.step.seen.frame
        if self._size == (0, 0):
            self._size = frame.shape[0], frame.shape[1]
        if frame.shape[:2] != self._size:
            raise ValueError(f"frames of {frame.shape[:2]} and {self._size} px do not go together")
        self._statistics[CAMERA].add(frame.reshape(-1, 3) / 255)
        _, png = cv2.imencode(".png", cv2.cvtColor(frame, cv2.COLOR_RGB2BGR))
        return {"bytes": png.tobytes(), "path": None}

    def _info(self) -> dict[str, Any]:
        frames = sum(one["length"] for one in self._episodes)
        rate = SECOND / self._period_ns
        return {
            "codebase_version": "v3.0",
            "robot_type": self._robot,
            "total_episodes": len(self._episodes),
            "total_frames": frames,
            "total_tasks": len(self._tasks),
            "chunks_size": CHUNK,
            "data_files_size_in_mb": 100,
            "video_files_size_in_mb": 200,
            "fps": round(rate) if abs(rate - round(rate)) < 1e-6 else rate,
            "splits": {"train": f"0:{len(self._episodes)}"},
            "data_path": DATA,
            "video_path": None,
            "features": self._features(),
        }

    def _features(self) -> dict[str, Any]:
        joints = {"dtype": "float32", "shape": [len(self._joints)], "names": self._joints}
        picture = {
            "dtype": "image",
            "shape": [*self._size, 3],
            "names": ["height", "width", "channels"],
        }
        counted = {name: _number("int64") for name in COUNTED}
        vectors = {CAMERA: picture, STATE: joints, ACTION: joints}
        return {**vectors, "timestamp": _number("float32"), **counted}


PICTURE = pa.struct([("bytes", pa.binary()), ("path", pa.string())])


def _number(kind: str) -> dict[str, Any]:
    return {"dtype": kind, "shape": [1], "names": None}


def _episodes(recording: Recording) -> Iterator[list[StepTold]]:
    steps: list[StepTold] = []
    for told in steps_told(recording):
        if told.step.begins and steps:
            yield steps
            steps = []
        steps.append(told)
    if steps:
        yield steps


def _tasks(tasks: Sequence[str]) -> Any:
    """The tasks, whose sentences are the table's index, as pandas would write it."""
    index, column = "__index_level_0__", {"metadata": None}
    text = {"pandas_type": "unicode", "numpy_type": "object"}
    whole = {"pandas_type": "int64", "numpy_type": "int64"}
    pandas = {
        "index_columns": [index],
        "column_indexes": [],
        "columns": [
            {"name": "task_index", "field_name": "task_index", **whole, **column},
            {"name": None, "field_name": index, **text, **column},
        ],
        "pandas_version": "2.2.0",
    }
    table = pa.table({"task_index": np.arange(len(tasks)), index: list(tasks)})
    return table.replace_schema_metadata({"pandas": json.dumps(pandas)})
