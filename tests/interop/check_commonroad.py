#!/usr/bin/env python3
"""Holds verdicts on CommonRoad scenarios against the project's own commonroad-drivability-checker.

    tests/interop/check_commonroad.py CORRIDOR FOLDER [--environment FOLDER]

runs the program CORRIDOR on every file of FOLDER that has a planning problem, lets it write its drive as a CommonRoad
solution, and asks the checker whether that drive collides and whether it reaches the goal. Both must agree. Whether the
drive is one of the kinematic single-track model is only reported: the car here has tyres. Whether it stays between the
lanelets is not asked: that needs a package that is not free.

Needs Python 3.10 and, for the first run, PyPI: the checker goes into a virtual environment, a temporary one unless named.
Exit code: 0 all agree, 1 some do not, 2 it could not be tried.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import venv

# The checker of this version does not know the reader's newer layout.
PACKAGES = ["commonroad-drivability-checker==2025.4.0", "commonroad-io<2026"]
INSIDE = "CORRIDOR_INTEROP_INSIDE"


def enter(environment: pathlib.Path) -> int:
    """Runs this script again inside the virtual environment, made first where it is not there."""
    python = environment / "bin" / "python"
    if not python.exists():
        venv.create(environment, with_pip=True)
    found = subprocess.run([python, "-c", "import commonroad_dc.feasibility.solution_checker"], capture_output=True, check=False)
    if found.returncode != 0:
        installed = subprocess.run([python, "-m", "pip", "install", "--quiet", *PACKAGES], check=False)
        if installed.returncode != 0:
            print(f"cannot install {PACKAGES}", file=sys.stderr)
            return 2
    return subprocess.run([python, *sys.argv], env={**os.environ, INSIDE: "1"}, check=False).returncode


def drive(program: str, file: pathlib.Path, solution: pathlib.Path) -> dict:
    """What the program says of its drive on a file."""
    run = subprocess.run([program, "run", file, "--solution", solution], capture_output=True, text=True, check=False)
    if run.returncode == 2:
        raise RuntimeError(run.stderr.strip().splitlines()[-1])
    collisions = re.search(r"no_collision +([0-9.]+)", run.stdout)
    summary = run.stdout.splitlines()[0]
    left_out = re.findall(r"`(\d+)` starts as the ego itself", run.stderr)
    return {
        "left out": [int(name) for name in left_out],
        "collides": float(collisions.group(1)) > 0.0,
        "reaches": "reached the goal" in summary,
        "summary": summary,
    }


def judge(file: pathlib.Path, solution: pathlib.Path, left_out: list) -> dict:
    """What the checker says of the same drive. A recording of the ego itself is in nobody's way."""
    from commonroad.common.file_reader import CommonRoadFileReader
    from commonroad.common.solution import CommonRoadSolutionReader
    from commonroad_dc.feasibility import solution_checker as checker

    scenario, problems = CommonRoadFileReader(str(file)).open()
    for name in left_out:
        scenario.remove_obstacle(scenario.obstacle_by_id(name))
    driven = CommonRoadSolutionReader.open(str(solution))

    def holds(question, *arguments):
        try:
            return bool(question(*arguments))
        except checker.SolutionCheckerException:
            return None

    # The checker raises where the answer is the bad one.
    collides = holds(checker.obstacle_collision, scenario, problems, driven) is not False
    reaches = holds(checker.goal_reached, scenario, problems, driven) is True
    starts = holds(checker.starts_at_correct_state, driven, problems) is True
    try:
        results = checker.solution_feasible(driven, scenario.dt, problems)
        feasible = all(result[0] for result in results.values())
    except checker.SolutionCheckerException:
        feasible = False
    return {"collides": collides, "reaches": reaches, "starts": starts, "feasible": feasible}


def compare(program: str, folder: pathlib.Path) -> int:
    """Prints a line per file and says how many disagree."""
    disagreeing = 0
    with tempfile.TemporaryDirectory() as scratch:
        for file in sorted(folder.glob("*.xml")):
            if "<planningProblem" not in file.read_text(encoding="utf-8"):
                print(f"skipped    {file.name}: no planning problem")
                continue
            solution = pathlib.Path(scratch) / file.name
            ours = drive(program, file, solution)
            theirs = judge(file, solution, ours["left out"])
            # A collision ends a run here: what would have come after it is not known.
            reaches = ours["collides"] or ours["reaches"] == theirs["reaches"]
            agrees = ours["collides"] == theirs["collides"] and reaches and theirs["starts"]
            disagreeing += not agrees
            word = "agrees    " if agrees else "DISAGREES "
            told = ", ".join(f"{key} {value}" for key, value in theirs.items())
            print(f"{word} {file.name}: {ours['summary']}; checker: {told}")
    return disagreeing


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the program to run")
    parser.add_argument("folder", type=pathlib.Path, help="CommonRoad files")
    parser.add_argument("--environment", type=pathlib.Path, help="where the checker is or will be installed")
    arguments = parser.parse_args()
    if os.environ.get(INSIDE) == "1":
        return 1 if compare(arguments.program, arguments.folder) else 0
    if arguments.environment:
        return enter(arguments.environment)
    with tempfile.TemporaryDirectory() as environment:
        return enter(pathlib.Path(environment))


if __name__ == "__main__":
    sys.exit(main())
