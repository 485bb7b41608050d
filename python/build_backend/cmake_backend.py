"""A PEP 517 and PEP 660 backend that builds the wheel of remodel with CMake. It needs nothing but Python, CMake and a
compiler.

The module is built in build/python-TAG, with as many jobs as CMAKE_BUILD_PARALLEL_LEVEL says, or as there are
processors. REMODEL_BUILD_DIRECTORY names a configured build directory to take it from instead. `pip install -v` shows
the build; without it a terminal gets one line that counts.

An editable install is a wheel with one .pth file, that of python/, and a link to the module beside the sources. A build
that fails leaves what is installed as it was.
"""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

try:
    import tomllib
except ImportError:  # before Python 3.11
    import tomli as tomllib

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "remodel"


def _version():
    return re.search(r'REMODEL_VERSION "(.+)"', (ROOT / "include/remodel/version.h").read_text())[1]


def _metadata():
    """The [project] table of pyproject.toml as a wheel has it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}", f"Summary: {project['description']}"]
    for author in project["authors"]:
        lines += [f"Author: {author['name']}", f"Author-email: {author['name']} <{author['email']}>"]
    lines += [f"Keywords: {','.join(project['keywords'])}", "License: MIT", f"License-File: {project['license']['file']}"]
    lines += [f"Project-URL: {name}, {url}" for name, url in project.get("urls", {}).items()]
    lines += [f"Classifier: {classifier}" for classifier in project["classifiers"]]
    lines += [f"Requires-Python: {project['requires-python']}"] + [f"Requires-Dist: {need}" for need in project["dependencies"]]
    for extra, needs in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}"] + [f"Requires-Dist: {need}; extra == '{extra}'" for need in needs]
    readme = (ROOT / project["readme"]).read_text(encoding="utf-8")
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", readme])


def _tag():
    version = "cp{}{}".format(*sys.version_info[:2])
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"{version}-{version}-{platform}"


def _info():
    return f"remodel-{_version()}.dist-info"


def _terminal():
    try:
        return open("/dev/tty", "w", encoding="utf-8")
    except OSError:
        return open(os.devnull, "w", encoding="utf-8")


def _run(*command):
    """Runs a command; what it prints goes to pip, which shows it with -v, and its counts to a terminal."""
    if shutil.which(command[0]) is None:
        raise SystemExit(f"remodel: found no {command[0]}, expected the packages of dependencies.txt, sections program and python")
    print("+", *command, flush=True)
    with subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace") as process, _terminal() as terminal:
        for line in process.stdout:
            print(line, end="", flush=True)
            if count := re.match(r"\[ *(\d+/\d+|\d+%)\]", line):
                terminal.write(f"\rbuilding remodel: {count[1]}  ")
                terminal.flush()
        terminal.write("\r")
    if process.returncode != 0:
        raise SystemExit(f"remodel: {command[0]} ended with status {process.returncode}; pip install -v shows why")


def _jobs():
    return os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(len(os.sched_getaffinity(0)))


def _built_module():
    """Builds the extension module; its path."""
    given = os.environ.get("REMODEL_BUILD_DIRECTORY")
    directory = Path(given) if given else ROOT / "build" / f"python-{_tag()}"
    if not given:
        parts = [f"-DREMODEL_{part}=OFF" for part in ("TESTS", "APP", "STUDY", "LIVE")]
        fresh = not (directory / "CMakeCache.txt").exists()
        generator = ["-G", "Ninja"] if fresh and shutil.which("ninja") else []
        _run("cmake", "-S", ROOT, "-B", directory, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
             "-DCMAKE_CXX_FLAGS=-w", *parts, "-DREMODEL_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}")  # fmt: skip
    _run("cmake", "--build", directory, "--target", "remodel_python", "--parallel", _jobs())
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    module = directory / "python" / "remodel" / f"_core{suffix}"
    if not module.exists():
        raise SystemExit(f"{directory}: found no _core{suffix}, expected a build directory for {sys.executable}")
    return module


def _record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def _info_files():
    return {
        "METADATA": _metadata().encode(),
        "LICENSE": (ROOT / "LICENSE").read_bytes(),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: remodel\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode(),
    }


def _wheel(directory, files):
    """Writes the wheel that has these files, and its own; its name."""
    files = {**files, **{f"{_info()}/{name}": data for name, data in _info_files().items()}}
    record = "".join(_record_line(name, data) for name, data in files.items()) + f"{_info()}/RECORD,,\n"
    files[f"{_info()}/RECORD"] = record.encode()
    name = f"remodel-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(Path(directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(path, data)
    return name


def get_requires_for_build_wheel(config_settings=None):
    return []


get_requires_for_build_sdist = get_requires_for_build_editable = get_requires_for_build_wheel


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    directory = Path(metadata_directory) / _info()
    directory.mkdir()
    for name, data in _info_files().items():
        (directory / name).write_bytes(data)
    return directory.name


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    module = _built_module()
    files = {f"remodel/{file.name}": file.read_bytes() for file in sorted(PACKAGE.iterdir()) if file.suffix in (".py", ".pyi") or file.name == "py.typed"}
    files[f"remodel/{module.name}"] = module.read_bytes()
    return _wheel(wheel_directory, files)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    module = _built_module().resolve()
    link = PACKAGE / module.name
    fresh = link.with_name(link.name + ".new")
    fresh.unlink(missing_ok=True)
    fresh.symlink_to(module)
    fresh.replace(link)
    return _wheel(wheel_directory, {"remodel-editable.pth": f"{PACKAGE.parent}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    base = f"remodel-{_version()}"
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, stdout=subprocess.PIPE).stdout
    with tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in filter(None, listed.decode().split("\0")):
            archive.add(ROOT / path, f"{base}/{path}", recursive=False)
        metadata = Path(sdist_directory) / "PKG-INFO"
        metadata.write_text(_metadata(), encoding="utf-8")
        archive.add(metadata, f"{base}/PKG-INFO")
        metadata.unlink()
    return f"{base}.tar.gz"
