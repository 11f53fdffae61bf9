# SPDX-License-Identifier: MIT
"""Rooms, the arrows that rooms.txt allows between them, and the arrows that the sources' includes make.

A room is a folder with sources, named by its path without `src/`. An arrow goes from a room to a room, or to a library
in angle brackets, of which the room includes a file."""

import collections
import pathlib
import re

SUFFIXES = {".h", ".hpp", ".c", ".cpp", ".glsl", ".comp"}
# Folders of includes, by the folder of the including file; the file's own folder comes first.
SEARCHED = {"include": ["include"], "shaders": ["shaders"], "src": ["src", "shaders", "include"],
            "apps": ["apps", "src", "shaders", "include"],
            "python": ["apps", "src", "shaders", "include"]}
# Headers of the system, which do not count as a library. Those of C++ have no extension.
SYSTEM = {"dlfcn.h", "fcntl.h", "fnmatch.h", "spawn.h", "stddef.h", "stdint.h", "sys/file.h", "sys/stat.h", "sys/wait.h",
          "unistd.h"}
# Guards of files that are not named after their place: the entry of what hosts include.
GUARDS = {"shaders/host/trace.glsl": "ZVO_TRACE_GLSL"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


def is_library(name):
    return name.startswith("<")


def read_allowed(path):
    """Room -> what it may include, in the order of the file. Returns it with a list of faults."""
    allowed, faults = {}, []
    text = re.sub(r"#.*", "", path.read_text(encoding="utf-8"))
    for line in re.sub(r"\n[ \t]+(?=\S)", " ", text).splitlines():  # an indented line continues the one before
        if not line.strip():
            continue
        room, colon, known = line.partition(":")
        if not colon or room in allowed:
            faults.append(f"{path.name}: '{line.strip()}' is no line of a new room")
            continue
        for name in known.split():
            if not is_library(name) and name not in allowed:
                faults.append(f"{path.name}: {room} may know {name}, which is not above it")
        allowed[room] = known.split()
    return allowed, faults


def read_arrows(root):
    """(room, what it includes) -> files that include it, for all rooms of the tree. Returns them with the rooms, in
    alphabetical order, and a list of faults."""
    arrows, rooms, faults = collections.defaultdict(list), set(), []
    for top, searched in SEARCHED.items():
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in SUFFIXES:
                continue
            room = room_of(root, path)
            rooms.add(room)
            for bracket, name in INCLUDE.findall(path.read_text(encoding="utf-8")):
                folders = [path.parent] if bracket == '"' else []
                files = [folder / name for folder in folders + [root / folder for folder in searched]]
                target = next((file for file in files if file.is_file()), None)
                if target is not None:
                    known = room_of(root, target)
                elif bracket == '"':
                    faults.append(f"{path.relative_to(root)}: no file is \"{name}\"")
                    continue
                elif "." not in name or name in SYSTEM:
                    continue
                else:
                    known = f"<{pathlib.PurePath(name).parts[0].split('.')[0]}>"
                if known != room:
                    arrows[room, known].append(str(path.relative_to(root)))
    return dict(arrows), sorted(rooms), faults


def room_of(root, path):
    return path.resolve().relative_to(root.resolve()).parent.as_posix().removeprefix("src/")


def find_unguarded(root):
    """Files of GLSL functions without an include guard of their own name."""
    faults = []
    for path in sorted((root / "shaders").rglob("*.glsl")):
        name = path.relative_to(root).as_posix()
        guard = GUARDS.get(name, "ZVO_" + re.sub(r"\W", "_", name).upper())
        if f"#ifndef {guard}\n#define {guard}\n" not in path.read_text(encoding="utf-8"):
            faults.append(f"{name} has no guard {guard}")
    return faults


def find_cycle(arrows):
    """Rooms that lead back to the first of them, which is also the last; or nothing."""
    known = collections.defaultdict(list)
    for room, target in sorted(arrows):
        known[room].append(target)
    done, way = set(), []

    def walk(room):
        if room in way:
            return way[way.index(room):] + [room]
        if room in done:
            return []
        done.add(room)
        way.append(room)
        for target in known[room]:
            cycle = walk(target)
            if cycle:
                return cycle
        way.pop()
        return []

    return next((cycle for cycle in map(walk, list(known)) if cycle), [])


def find_faults(root, allowed_path):
    """What is wrong with the tree's arrows, a line each."""
    allowed, faults = read_allowed(allowed_path)
    arrows, rooms, more = read_arrows(root)
    faults += more + find_unguarded(root)
    name = allowed_path.name
    faults += [f"{name} does not have the room {room}" for room in rooms if room not in allowed]
    faults += [f"{name} has {room}, in which there is no source" for room in allowed if room not in rooms]
    for (room, known), files in sorted(arrows.items()):
        if known not in allowed.get(room, [known]):
            faults.append(f"{room} -> {known} is not allowed: {', '.join(files)}")
    for room, known_rooms in allowed.items():
        faults += [f"{name}: nobody uses {room} -> {known}" for known in known_rooms if (room, known) not in arrows]
    cycle = find_cycle(arrows)
    return faults + ([f"a cycle: {' -> '.join(cycle)}"] if cycle else [])
