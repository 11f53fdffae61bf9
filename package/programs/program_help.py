# SPDX-License-Identifier: MIT
"""What a program's --help says, as CLI11 writes it: one Page for the program and one for each of its commands."""

import re
import subprocess
from dataclasses import dataclass, field

ENTRY = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")
WORD = re.compile(r"-?[a-z0-9]+")


@dataclass
class Entry:
    """A line of the lists: an option, something positional, or a command."""
    flags: list  # ["-o", "--output"]; of what has none, the name alone
    value: str  # what stands for the option's value; empty: it takes none
    notes: str  # such as "REQUIRED"
    text: str

    def choices(self):
        """The values that are possible, where the help lists them; else nothing."""
        if "|" in self.value:
            return all_words(self.value.split("|"))
        listed = re.sub(r" *\([^)]*\)", "", self.text.split(": ", 1)[-1].split(";")[0])
        words = all_words(re.split(r", | or ", listed))
        return words if len(words) > 2 else []

    def takes_folder(self):
        return self.value == "DIR"


def all_words(words):
    return words if all(WORD.fullmatch(word) for word in words) else []


@dataclass
class Page:
    command: list  # ["zvo", "render"]
    about: str = ""
    usage: str = ""
    groups: list = field(default_factory=list)  # [(title, [Entry])]
    footer: list = field(default_factory=list)  # lines

    def entries(self, title):
        return [entry for name, entries in self.groups if name == title for entry in entries]

    def options(self):
        return [entry for _, entries in self.groups for entry in entries if entry.flags[0].startswith("-")]


def entry_of(head, text):
    flags, _, rest = head.partition(" ")
    value, _, notes = rest.partition(" ")
    if value == "Excludes:":
        value, notes = "", rest
    return Entry(flags.split(","), value, notes, text)


def parse(command, text):
    page = Page(command)
    lines = text.split("\n")
    page.about = lines[0]
    page.usage = lines[1].removeprefix("Usage: ")
    at = 2
    while at < len(lines):
        title = re.fullmatch(r"(\w+):", lines[at])
        if title and title[1] != "Examples" and lines[at + 1:] and lines[at + 1].startswith("  "):
            entries = []
            at += 1
            while at < len(lines) and lines[at].startswith("  "):
                head, text_ = ENTRY.match(lines[at]).groups()
                if text_ is None and lines[at + 1].startswith("   "):
                    at += 1
                    text_ = lines[at].strip()
                entries.append(entry_of(head, text_ or ""))
                at += 1
            page.groups.append((title[1], entries))
        elif lines[at] == "" and not page.footer:
            at += 1
        else:
            page.footer.append(lines[at])
            at += 1
    while page.footer and page.footer[-1] == "":
        page.footer.pop()
    return page


def help_text(program, words):
    return subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout


def pages(program, name):
    """Of the program at this path, which is called so: first its own, then those of its commands."""
    first = parse([name], help_text(program, []))
    commands = [entry.flags[0] for entry in first.entries("Subcommands")]
    return [first] + [parse([name, command], help_text(program, [command])) for command in commands]


def version(program):
    return subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
