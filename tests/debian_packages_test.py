"""Makes the Debian packages, unpacks them, runs the program out of them and builds a consumer against their files.

    debian_packages_test.py BUILD_DIRECTORY SCRATCH_DIRECTORY      exit status 77 where Debian's tools are missing
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]


def run(*command, **options):
    command = [str(part) for part in command]
    process = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, **options)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: exit status {process.returncode}\n{process.stdout}")
    return process.stdout


def expect(condition, message):
    if not condition:
        raise SystemExit(message)


def make_packages(build, scratch):
    """The packages by name."""
    run("cpack", "-G", "DEB", "--config", build / "CPackConfig.cmake", "-B", scratch / "packages", cwd=build)
    return {run("dpkg-deb", "-f", file, "Package").strip(): file for file in (scratch / "packages").glob("*.deb")}


def check_fields(packages):
    version = re.search(r'REMODEL_VERSION "(.+)"', (SOURCE / "include/remodel/version.h").read_text())[1]
    depends = {}
    for name, file in packages.items():
        expect(run("dpkg-deb", "-f", file, "Version").strip() == version, f"{file.name}: expected version {version}")
        depends[name] = run("dpkg-deb", "-f", file, "Depends")
        expect(f"/usr/share/doc/{name}/copyright" in run("dpkg-deb", "-c", file), f"{file.name}: no copyright file")
    for library in ("libc6", "libstdc++6", "libsqlite3-0", "libcairo2"):
        expect(library in depends["remodel"], f"remodel depends on '{depends['remodel']}', expected {library} too")
    expect("openmpi" not in depends["remodel"], f"remodel depends on '{depends['remodel']}', expected no MPI")
    for library in ("libhdf5-dev", "libsqlite3-dev", "libcairo2-dev"):
        expect(library in depends["libremodel-dev"], f"libremodel-dev does not depend on {library}")
    if "python3-remodel" in packages:
        wanted = r"python3 \(>= 3\.\d+\), python3 \(<< 3\.\d+\), python3-numpy"
        expect(re.search(wanted, depends["python3-remodel"]), f"python3-remodel depends on '{depends['python3-remodel']}'")
    if "remodel-mpi" in packages:
        expect("openmpi" in depends["remodel-mpi"], f"remodel-mpi depends on '{depends['remodel-mpi']}', expected MPI")


def use_program(program, scratch):
    version = run(program, "--version").strip()
    run(program, "mesh", "naca:0012", "--points", "50", "-o", "start.vtkhdf", cwd=scratch)
    run(program, "update", "start.vtkhdf", "naca:2412", "-o", "next.su2", cwd=scratch)
    run(program, "check", "next.su2", cwd=scratch)
    expect((scratch / "next.su2").stat().st_size > 0, "next.su2 is empty")
    print(f"remodel {version} runs out of its package")


def use_module(root, scratch):
    """The Python package, by Debian's own Python."""
    packages = next(root.glob("usr/lib/python3/dist-packages"))
    script = "import remodel; mesh = remodel.generate('naca:0012', points=50); print(mesh.update('naca:2412'), mesh.check().valid)"
    shown = run("/usr/bin/python3", "-B", "-c", script, cwd=scratch, env={"PYTHONPATH": str(packages), "PATH": "/usr/bin:/bin"})
    expect(shown.strip().endswith("True"), f"the module printed '{shown}', expected True")


def use_libraries(root, scratch):
    """The README's example and a consumer of core alone, with what lies in the package."""
    consumers = SOURCE / "tests/consumer"
    for name, options in (("whole", [f"-DEXAMPLE={SOURCE / 'examples/example.cpp'}"]), ("core", [])):
        build = scratch / name
        run("cmake", "-G", "Ninja", "-S", consumers / name, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
            f"-Dremodel_ROOT={root / 'usr'}", *options)  # fmt: skip
        found = re.search(r"^remodel_DIR:PATH=(.*)$", (build / "CMakeCache.txt").read_text(), re.MULTILINE)[1]
        expect(Path(found).is_relative_to(root), f"found {found}, expected the package in {root}")
        run("cmake", "--build", build)
        print(run(build / "consumer", cwd=scratch).splitlines()[-1])


def main(build, scratch):
    if any(shutil.which(tool) is None for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps")):
        return 77
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    packages = make_packages(build, scratch)
    expect({"remodel", "libremodel-dev"} <= set(packages), f"found the packages {sorted(packages)}")
    check_fields(packages)
    root = scratch / "root"
    for file in packages.values():
        run("dpkg-deb", "-x", file, root)
    use_program(root / "usr/bin/remodel", scratch)
    if "python3-remodel" in packages:
        use_module(root, scratch)
    use_libraries(root, scratch)
    shutil.rmtree(scratch)
    return 0


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:3])))
