#!/usr/bin/env python3
"""A stand-in for SU2_CFD, for Euler's equations: it relaxes a made-up flow at the mesh's points until its residual is small.

What SU2 8.0.1 refuses it refuses too, by the rules of that version's sources (Common/src/CConfig.cpp, option_structure.hpp,
SU2_CFD/src/solvers/CSolver.cpp): lines without `=`, options that do not exist or appear twice, values of another type, names
that are none of an option's, no SOLVER, no mesh, markers of the mesh that the configuration does not define, restart files that
are missing, binary, or end before the mesh's points do. It is stricter than SU2 where a mistake of ours would show in nothing
but slow convergence: it knows only the options and outputs that our cases have, refuses markers of the configuration that the
mesh does not have, restart files with rows too many, other first columns or other coordinates, and fields of the history that
do not exist, which SU2 leaves out.
"""

import math
import re
import sys
from pathlib import Path

CHOICES = {  # SLOPE_LIMITER_FLOW and so on: all names that 8.0.1 has
    "SOLVER": "NONE EULER NAVIER_STOKES RANS INC_EULER INC_NAVIER_STOKES INC_RANS HEAT_EQUATION ELASTICITY",
    "MATH_PROBLEM": "DIRECT CONTINUOUS_ADJOINT DISCRETE_ADJOINT",
    "SYSTEM_MEASUREMENTS": "SI US",
    "REF_DIMENSIONALIZATION": "DIMENSIONAL FREESTREAM_PRESS_EQ_ONE FREESTREAM_VEL_EQ_MACH FREESTREAM_VEL_EQ_ONE",
    "NUM_METHOD_GRAD": "NONE GREEN_GAUSS LEAST_SQUARES WEIGHTED_LEAST_SQUARES",
    "CONV_NUM_METHOD_FLOW": "JST JST_KE JST_MAT LAX-FRIEDRICH ROE TURKEL_PREC AUSM AUSMPLUSUP AUSMPLUSUP2 AUSMPLUSM SLAU HLLC "
                            "SW MSW",
    "SLOPE_LIMITER_FLOW": "NONE VENKATAKRISHNAN NISHIKAWA_R3 NISHIKAWA_R4 NISHIKAWA_R5 VENKATAKRISHNAN_WANG BARTH_JESPERSEN "
                          "VAN_ALBADA_EDGE SHARP_EDGES WALL_DISTANCE",
    "TIME_DISCRE_FLOW": "RUNGE-KUTTA_EXPLICIT EULER_EXPLICIT EULER_IMPLICIT CLASSICAL_RK4_EXPLICIT",
    "LINEAR_SOLVER": "CONJUGATE_GRADIENT BCGSTAB FGMRES RESTARTED_FGMRES SMOOTHER",
    "LINEAR_SOLVER_PREC": "JACOBI LU_SGS LINELET ILU",
    "TABULAR_FORMAT": "CSV TECPLOT",
    "MESH_FORMAT": "SU2 CGNS",
}
REALS = """MACH_NUMBER AOA FREESTREAM_PRESSURE FREESTREAM_TEMPERATURE REF_LENGTH REF_AREA TARGET_CL DCL_DALPHA CFL_NUMBER
LINEAR_SOLVER_ERROR CONV_RESIDUAL_MINVAL VENKAT_LIMITER_COEFF""".split()
COUNTS = "ITER LINEAR_SOLVER_ITER CONV_STARTITER UPDATE_AOA_ITER_LIMIT ITER_DCL_DALPHA".split()
SWITCHES = "FIXED_CL_MODE MUSCL_FLOW CFL_ADAPT RESTART_SOL READ_BINARY_RESTART".split()
TEXTS = "MESH_FILENAME SOLUTION_FILENAME RESTART_FILENAME CONV_FILENAME".split()
LISTS = {name: None for name in """REF_ORIGIN_MOMENT_X REF_ORIGIN_MOMENT_Y REF_ORIGIN_MOMENT_Z CFL_ADAPT_PARAM JST_SENSOR_COEFF
MARKER_EULER MARKER_FAR MARKER_PLOTTING MARKER_MONITORING""".split()}
LISTS |= {
    "SCREEN_OUTPUT": {"INNER_ITER", "RMS_DENSITY", "LIFT", "DRAG", "AOA"},
    "HISTORY_OUTPUT": {"ITER", "RMS_RES", "AERO_COEFF", "AOA"},
    "CONV_FIELD": {"RMS_DENSITY", "LIFT", "DRAG"},
    "OUTPUT_FILES": {"RESTART", "RESTART_ASCII", "CSV", "PARAVIEW", "SURFACE_CSV"},
}
REAL_LISTS = {"REF_ORIGIN_MOMENT_X", "REF_ORIGIN_MOMENT_Y", "REF_ORIGIN_MOMENT_Z", "CFL_ADAPT_PARAM", "JST_SENSOR_COEFF"}
COLUMNS = ["PointID", "x", "y", "Density", "Momentum_x", "Momentum_y", "Energy"]


def error(text):
    print(f"\nError in a stand-in for SU2_CFD:\n{'-' * 70}\n{text}")
    sys.exit(1)


def number(name, text, kind=float):
    try:
        return kind(text)
    except ValueError:
        error(f"{name}: improper option value for option of type {'su2double' if kind is float else 'unsigned long'}: {text}")


def value_of(name, words):
    if name in LISTS:
        if name in REAL_LISTS:
            return [number(name, word) for word in words]
        if unknown := [word for word in words if LISTS[name] is not None and word not in LISTS[name]]:
            error(f"{name}: {unknown[0]} does not exist")
        return words
    if len(words) != 1:
        error(f"{name}: multiple values for option of one: {words}")
    word = words[0]
    if name in CHOICES:
        if word not in CHOICES[name].split():
            error(f"{name}: invalid option value {word}. Did you mean {CHOICES[name]}?")
        return word
    if name in SWITCHES:
        if word not in ("YES", "NO"):
            error(f"{name}: improper option value for option of type bool: {word}")
        return word == "YES"
    if name in COUNTS:
        return number(name, word, int)
    return number(name, word) if name in REALS else word


def configuration(file):
    found = {}
    for count, line in enumerate(Path(file).read_text().splitlines(), 1):
        line = line.split("%")[0]
        if not line.strip(" (){}:,\t"):
            continue
        name, equals, value = line.partition("=")
        name, words = name.strip().upper(), re.findall(r"[^\s(){}:,]+", value)
        if not equals or not words:
            error(f"line {count}: no {'value assigned' if equals else '= sign'}: {line}")
        if name not in {*CHOICES, *REALS, *COUNTS, *SWITCHES, *TEXTS, *LISTS}:
            error(f"Line {count} {name}: invalid option name. Check current SU2 options in config_template.cfg.")
        if name in found:
            error(f"Line {count} {name}: option appears twice")
        found[name] = value_of(name, words)
    for name in ("SOLVER", "MARKER_EULER", "MARKER_FAR", "MESH_FILENAME", "MACH_NUMBER", "ITER"):
        if name not in found:
            error(f"{name} must be in the configuration")
    if found["SOLVER"] != "EULER":
        error("the stand-in has SOLVER= EULER alone")
    if found.get("FIXED_CL_MODE") and found.get("UPDATE_AOA_ITER_LIMIT") == 0:
        error("ERROR: Please specify non-zero UPDATE_AOA_ITER_LIMIT.")
    return found


def read_mesh(config):
    file = Path(config["MESH_FILENAME"])
    if not file.exists():
        error(f"Error opening SU2 ASCII grid: {file}")
    points, markers, dimensions = [], {}, None
    lines = iter(file.read_text().splitlines())
    for line in lines:
        key, _, value = line.partition("=")
        if key == "NDIME":
            dimensions = int(value)
        elif key == "NPOIN":
            points = [tuple(map(float, next(lines).split()[:2])) for _ in range(int(value.split()[0]))]
        elif key == "MARKER_TAG":
            count = int(next(lines).split("=")[1])
            markers[value.strip()] = [tuple(map(int, next(lines).split()[1:3])) for _ in range(count)]
    if dimensions != 2 or not points or not markers:
        error(f"{file} is no mesh of two dimensions with points and markers")
    defined = config["MARKER_EULER"] + config["MARKER_FAR"]
    for name in markers:
        if name not in defined:
            error(f"The configuration file doesn't have any definition for marker {name}")
    for option in ("MARKER_EULER", "MARKER_FAR", "MARKER_PLOTTING", "MARKER_MONITORING"):
        for name in config.get(option, []):
            if name not in markers:
                error(f"{option}: the mesh has no marker {name}")
    return points, markers


def start(config, points):
    if not config.get("RESTART_SOL"):
        return [[1.0, 0.5, 0.0, 2.0] for _ in points]
    if config.get("READ_BINARY_RESTART", True):
        error("the stand-in reads READ_BINARY_RESTART= NO alone")
    file = Path(config["SOLUTION_FILENAME"] + ".csv")
    if not file.exists():
        error(f"SU2 ASCII restart file {file} not found.")
    names, *rows = file.read_text().splitlines()
    if [name.strip().strip('"') for name in names.split(",")][: len(COLUMNS)] != COLUMNS:
        error(f"{file} has other columns than {COLUMNS}: {names}")
    if len(rows) != len(points):
        error("The solution file does not match the mesh, currently only binary files can be interpolated.")
    state = []
    for i, (row, point) in enumerate(zip(rows, points)):
        values = [number(str(file), word) for word in row.split(",")]
        if len(values) != len(names.split(",")) or values[0] != i or math.dist(values[1:3], point) > 1e-9:
            error(f"{file}: row {i} is of another point, or has other columns: {row}")
        if not (values[3] > 0 and all(map(math.isfinite, values))):
            error("SU2 has diverged (NaN detected).")
        state.append(values[3:7])
    return state


def main(file):
    config = configuration(file)
    points, markers = read_mesh(config)
    state = start(config, points)
    wall = [edge for name in config["MARKER_EULER"] for edge in markers[name]]
    area = 0.5 * abs(sum(points[a][0] * points[b][1] - points[a][1] * points[b][0] for a, b in wall))
    base = [(1 + 0.1 * math.tanh(x), 0.5, 0.1 * math.tanh(y), 2 + 0.2 * math.tanh(x * y) + area) for x, y in points]
    alpha, names = config["AOA"], ["Inner_Iter", "rms[Rho]", "CD", "CL"]
    if "AOA" in config.get("HISTORY_OUTPUT", []):
        names.append("AoA")
    with open(config["CONV_FILENAME"] + ".csv", "w") as history:
        history.write(",".join(f'    "{name}"    ' for name in names) + "\n")
        for iteration in range(config["ITER"]):
            turned = sum(s[2] - b[2] for s, b in zip(state, base)) / len(points) / 0.01  # the angle that the flow has
            lift = 3 * area + 0.11 * turned + 0.002 * turned**2
            target = [(b[0], b[1], b[2] + 0.01 * alpha, b[3]) for b in base]
            off = max(max(map(abs, map(float.__sub__, t, s))) for t, s in zip(target, state))
            row = [iteration, math.log10(off + 1e-16), area * area + 0.01 * lift**2, lift, alpha]
            history.write(", ".join(map(repr, row[: len(names)])) + "\n")
            fixed = config.get("FIXED_CL_MODE") and abs(config["TARGET_CL"] - lift) > 1e-5
            if iteration >= config.get("CONV_STARTITER", 5) and row[1] <= config.get("CONV_RESIDUAL_MINVAL", -14) and not fixed:
                break
            state = [[s + 0.1 * (t - s) for s, t in zip(a, b)] for a, b in zip(state, target)]
            if fixed and (iteration + 1) % config.get("UPDATE_AOA_ITER_LIMIT", 200) == 0:
                alpha += (config["TARGET_CL"] - lift) / config["DCL_DALPHA"]
    with open(config["RESTART_FILENAME"] + ".csv", "w") as restart:
        restart.write(",".join(f'"{name}"' for name in COLUMNS) + "\n")
        for i, (p, s) in enumerate(zip(points, state)):
            restart.write(", ".join([str(i), *(f"{v:.15e}" for v in (*p, *s))]) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        error("expected one configuration")
    main(sys.argv[1])
