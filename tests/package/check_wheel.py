"""Checks what a wheel holds: the package and, where it was repaired, Box2D; nothing else.

Argument: the wheel.
"""

import re
import sys
import zipfile
from pathlib import Path

wheel = Path(sys.argv[1])
source = Path(__file__).resolve().parents[2]
with zipfile.ZipFile(wheel) as archive:
    names = {name for name in archive.namelist() if not name.endswith("/")}

package = source / "python" / "devlearn"
expected = {
    path.relative_to(package.parent).as_posix()
    for path in package.rglob("*")
    if path.is_file() and "__pycache__" not in path.parts
}
info = {name for name in names if re.match(r"devlearn-[^/]+\.dist-info/", name)}
compiled = {name for name in names if re.fullmatch(r"devlearn/_core\.[^/]+\.so", name)}
repaired = "manylinux" in wheel.name
carried = {name for name in names if re.fullmatch(r"devlearn\.libs/libbox2d-[^/]+\.so[.\d]*", name)}

problems = [f"is missing: {name}" for name in sorted(expected - names)]
problems += [
    f"does not belong: {name}" for name in sorted(names - expected - info - compiled - carried)
]
if len(compiled) != 1:
    problems.append(f"compiled modules: {sorted(compiled)}, expected one")
if len(carried) != repaired:
    problems.append(f"libraries carried: {sorted(carried)}, expected {int(repaired)}")
for licence in ("LICENSE", "NOTICE"):
    if not any(name.endswith(f"/{licence}") for name in info):
        problems.append(f"is missing: {licence}")

for problem in problems:
    print(f"{wheel.name}: {problem}", file=sys.stderr)
if problems:
    sys.exit(1)
print(f"{wheel.name}: {len(names)} files, {wheel.stat().st_size // 1024} KiB")
