"""An include never points up. The layers, lowest first; ARCHITECTURE.md says the same in words.

    layers_test.py [SOURCE_DIRECTORY]
"""

import re
import sys
from pathlib import Path

# Directories of src/ (and study/ and app/), lowest first, and the public headers that belong to each. A layer may
# include itself and every layer before it, unless ONLY says less.
LAYERS = [
    {"name": "base", "headers": []},
    {"name": "geometry", "headers": ["point.h", "predicates.h", "error.h", "version.h"]},
    {"name": "triangulation", "headers": ["ids.h"]},
    {"name": "shape", "headers": ["airfoil.h", "airfoil_degree.h", "domain.h", "join.h"]},
    {"name": "planar", "headers": ["planar.h"]},
    {"name": "mesh", "headers": ["mesh.h", "mesh_state.h", "changes.h", "frozen_mesh.h", "field.h"]},
    {"name": "generate", "headers": ["generate.h", "limits.h"]},
    {"name": "import", "headers": ["import.h"]},
    {"name": "step", "headers": ["remodel.h", "mesh_derivative.h", "displacement.h"]},
    {"name": "layer", "headers": ["layers.h"]},
    {"name": "transfer", "headers": ["transfer.h", "snapshots.h"]},
    {"name": "check", "headers": ["check.h"]},
    {"name": "flow", "headers": ["flow.h", "flow_error.h", "potential_flow.h"]},
    {"name": "io", "headers": ["foam.h", "io.h", "shape_domain.h", "shape_files.h", "su2_restart.h"]},
    {"name": "draw", "headers": ["draw.h", "film.h", "plot.h"]},
    {
        "name": "design",
        "headers": [
            "optimise.h", "designer.h", "evaluation.h", "evaluator.h", "design_space.h", "living_mesh.h", "figures.h",
            "replay.h", "batch.h", "noise.h", "directory_lock.h", "cmaes.h", "sqp.h", "history.h", "soak.h", "crew.h",
        ],
    },
    {"name": "aero", "headers": ["boundary_layer.h", "deformation.h", "design_problem.h", "design_run.h", "flow_function.h", "flow_layer.h", "flow_noise.h", "flow_plots.h", "flow_space.h", "polar.h", "sweep.h"]},
    {"name": "python", "headers": []},
    {"name": "study", "headers": []},
    {"name": "app", "headers": []},
]
# Some layers see less than everything below them.
ONLY = {
    # The kernel knows nothing of airfoils, and shapes know no triangulation.
    "shape": {"base", "geometry"},
    # The validator shares no predicate and no data structure with what it validates: public, frozen values only.
    "check": {"check", "point.h", "error.h", "airfoil.h", "domain.h", "frozen_mesh.h"},
    # Pictures are of the frozen view.
    "draw": {"draw", "base", "geometry", "io", "point.h", "error.h", "frozen_mesh.h", "field.h", "io.h"},
    # The Python package uses public headers, like every other user.
    "python": {"python"} | {header for layer in LAYERS for header in layer["headers"]},
    # The program uses the library's public headers, like every other user, and the study's.
    "app": {"app", "base", "study"} | {header for layer in LAYERS for header in layer["headers"]},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def layer_of_header(header):
    for layer in LAYERS:
        if header in layer["headers"]:
            return layer["name"]
    raise SystemExit(f"include/remodel/{header}: not in the table of {__file__}")


def layer_of_include(file, include, source):
    """The layer of what is included, and its public header's name, if it is one."""
    if include.startswith("remodel/"):
        header = include.removeprefix("remodel/")
        return layer_of_header(header), header
    for base in (file.parent, source / "src", source, source / "app"):
        path = (base / include).resolve()
        if path.exists() and path.is_relative_to(source):
            return layer_of_file(path, source), None
    raise SystemExit(f'{file.relative_to(source)}: includes "{include}", which is not there')


def layer_of_file(path, source):
    parts = path.relative_to(source).parts
    if parts[0] == "app" or parts[:2] == ("study", "app"):
        return "app"
    if parts[0] in ("python", "study"):
        return parts[0]
    if parts[0] == "include":
        return layer_of_header(parts[-1])
    return parts[1]


def allowed(from_layer, to_layer, header):
    order = [layer["name"] for layer in LAYERS]
    if order.index(to_layer) > order.index(from_layer):
        return False
    if from_layer in ONLY and to_layer != from_layer:
        return to_layer in ONLY[from_layer] or header in ONLY[from_layer]
    return True


def is_test(file):
    return file.stem.endswith("_test") or file.stem.startswith("test_")


def main(source):
    source = source.resolve()
    files = [f for d in ("include", "src", "python", "study", "app") for f in (source / d).rglob("*") if f.suffix in (".h", ".cpp")]
    broken = []
    for file in sorted(files):
        if is_test(file):
            continue
        layer = layer_of_file(file, source)
        for include in INCLUDE.findall(file.read_text()):
            target, header = layer_of_include(file, include, source)
            if not allowed(layer, target, header):
                broken.append(f'{file.relative_to(source)} ({layer}) includes "{include}" ({target})')
    architecture = " ".join((source / "ARCHITECTURE.md").read_text().split())
    graph = " → ".join(layer["name"] for layer in LAYERS)
    if graph not in architecture:
        broken.append(f"ARCHITECTURE.md does not contain the layers as they are here: {graph}")
    print(*broken, sep="\n")
    print(f"{len(files)} files, {len(broken)} broken rules")
    return 1 if broken or not files else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1])))
