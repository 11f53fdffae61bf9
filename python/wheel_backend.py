# SPDX-License-Identifier: MIT
"""Makes a wheel for pip (PEP 517) by CMake, of nothing but what Debian's packages have: the wheel is what
`cmake --install --component python` installs. $ZVO_BUILD names a folder of a build; by default it is build/wheel."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

SOURCES = pathlib.Path(__file__).resolve().parents[1]


def version():
    header = (SOURCES / "include/zvo/version.h").read_text(encoding="utf-8")
    return ".".join(re.search(rf"ZVO_VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH"))


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def metadata():
    return {"METADATA": f"Metadata-Version: 2.1\nName: zvo\nVersion: {version()}\nRequires-Python: >=3.9\n"
                        "Requires-Dist: numpy>=1.23\nLicense: MIT\n"
                        "Summary: Voxels of meshes and points, made and traced on Vulkan devices\n",
            "WHEEL": f"Wheel-Version: 1.0\nGenerator: zvo\nRoot-Is-Purelib: false\nTag: {tag()}\n"}


def install(folder):
    """Builds the package, and installs it into a folder."""
    build = pathlib.Path(os.environ.get("ZVO_BUILD", SOURCES / "build/wheel"))

    def cmake(*arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True, cwd=SOURCES)

    preset = [] if (build / "CMakeCache.txt").exists() else ["--preset", "run"]
    cmake(*preset, "-B", build, "-DZVO_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}")
    cmake("--build", build, "--target", "zvo_python")
    cmake("--install", build, "--component", "python", "--strip", "--prefix", folder)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"zvo-{version()}-{tag()}.whl"
    information = f"zvo-{version()}.dist-info"
    with tempfile.TemporaryDirectory() as folder, \
            zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        install(folder)
        package = next(pathlib.Path(folder).rglob("zvo/__init__.py")).parent
        files = {f"zvo/{path.name}": path.read_bytes() for path in sorted(package.iterdir())}
        files |= {f"{information}/{file}": text.encode() for file, text in metadata().items()}
        record = ""
        for path, content in files.items():
            wheel.writestr(path, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(content)}\n"
        wheel.writestr(f"{information}/RECORD", f"{record}{information}/RECORD,,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("zvo: there is no package of sources; build a wheel from zvo's own sources")
