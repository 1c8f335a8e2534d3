#!/usr/bin/env python3
"""The manual page and what bash, zsh and fish propose, compared with --help of every command. A shell that is not installed is skipped.

usage: test_shell.py PROGRAM [TEST...]
"""

import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from case import PATIENCE

PROGRAM = str(Path(sys.argv[1]).resolve())
LAWS = ["iwan", "iwan_four_parameter"]

# The line so far, and what is proposed.
LINES = [
    ("dualdamp laws iw", LAWS),
    ("dualdamp fit iw", LAWS),
    ("dualdamp fit coulomb ", ["a.yaml", "b.csv", "folder", "law.so"]),
    ("dualdamp identify b.csv --method recu", ["recursive_least_squares"]),
    ("dualdamp identify b.csv --coordinate ", ["angle", "displacement"]),
    ("dualdamp fit coulomb b.csv --drive ", ["force", "y"]),
    ("dualdamp run ", ["a.yaml", "folder"]),
    ("dualdamp run --out run ", ["a.yaml", "folder"]),  # the second "run" is a value
    ("dualdamp run a.yaml --out ", ["folder"]),
    ("dualdamp run a.yaml --plugin ", ["folder", "law.so"]),
    ("dualdamp stress ", ["export", "score"]),
    ("dualdamp stress export ", ["a.yaml", "folder"]),
    ("dualdamp completion ", ["bash", "fish", "zsh"]),
    ("dualdamp analyses regime", ["regime_map"]),
]


def call(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE * 60, check=True, **options).stdout


def commands(name=()):
    """The name of the program and of every command as words, with its options."""
    text = call(PROGRAM, *name, "--help")
    yield name, sorted(set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE)))
    below = text.partition("\nSubcommands:\n")[2]
    for word in re.findall(r"^  (\w+)", below, re.MULTILINE):
        yield from commands((*name, word))


class Shell:
    """The tests of a shell; `proposed` gives what it proposes for a line."""

    def setUp(self):
        if shutil.which(self.shell) is None:
            self.skipTest(f"{self.shell} is not installed")
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "scripts").mkdir()
        (self.folder / "scripts/_dualdamp").write_text(call(PROGRAM, "completion", self.shell))
        self.place = self.folder / "place"
        (self.place / "folder").mkdir(parents=True)
        for name in ("a.yaml", "b.csv", "law.so"):
            (self.place / name).touch()

    def test_lines(self):
        for line, expected in LINES:
            with self.subTest(line):
                self.assertEqual(self.proposed(line), expected)

    def test_options(self):
        for name, options in commands():
            with self.subTest(" ".join(name)):
                self.assertEqual(self.proposed(" ".join(["dualdamp", *name, "--"])), options)

    def test_commands(self):
        names = [name for name, _ in commands() if len(name) == 1]
        self.assertGreater(len(names), 10)
        self.assertEqual(self.proposed("dualdamp "), sorted(name[0] for name in names))


class Bash(Shell, unittest.TestCase):
    shell = "bash"

    def proposed(self, line):
        words = line.split(" ")
        script = 'source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _dualdamp; printf "%s\\n" "${COMPREPLY[@]}"'
        found = call("bash", "--norc", "-c", script, self.folder / "scripts/_dualdamp", *words, cwd=self.place)
        return sorted(found.split())

    def test_the_last_item_of_a_list(self):
        self.assertEqual(self.proposed("dualdamp fit coulomb,iw"), [f"coulomb,{law}" for law in LAWS])


class Fish(Shell, unittest.TestCase):
    shell = "fish"

    def proposed(self, line):
        script = 'source $argv[1]; complete -C $argv[2]'
        found = call("fish", "--no-config", "-c", script, self.folder / "scripts/_dualdamp", line, cwd=self.place, env={**os.environ, "HOME": str(self.folder)})
        return sorted(row.split("\t")[0].rstrip("/") for row in found.splitlines())


class Zsh(Shell, unittest.TestCase):
    """zsh completes only where somebody types: a terminal is played to it."""

    shell = "zsh"

    def setUp(self):
        super().setUp()
        pid, self.terminal = pty.fork()
        if pid == 0:
            os.chdir(self.place)
            os.environ.update(TERM="dumb", HOME=str(self.folder), ZDOTDIR=str(self.folder))
            os.execvp("zsh", ["zsh", "-f", "-i"])
        self.addCleanup(os.waitpid, pid, 0)
        self.addCleanup(os.close, self.terminal)
        # Ctrl-X prints what is proposed for the line, <one> in each row, and empties the line.
        setup = [
            f"fpath=({self.folder}/scripts $fpath); autoload -Uz compinit; compinit -u -D",
            "compadd() { local -a found; builtin compadd -O found \"$@\"; print -rl -- '<'${^found}'>'; builtin compadd \"$@\" }",
            "propose() { zle list-choices; BUFFER=; print fini''shed }; zle -N propose; bindkey '^X' propose",
            "unsetopt zle_bracketed_paste; LISTMAX=1000; PS1=; print rea''dy",
        ]
        os.write(self.terminal, ("\n".join(setup) + "\n").encode())
        self.read_until(b"ready")

    def proposed(self, line):
        os.write(self.terminal, line.encode() + b"\x18")
        return sorted(set(re.findall(r"<([^<>\r\n]+)>", self.read_until(b"finished").decode())))

    def read_until(self, mark):
        text = b""
        while mark not in text:
            self.assertTrue(select.select([self.terminal], [], [], 60)[0], f"zsh is silent after {text!r}")
            text += os.read(self.terminal, 65536)
        return text


class Manual(unittest.TestCase):
    def setUp(self):
        self.page = call(PROGRAM, "manual")

    def test_every_command_and_option(self):
        sections = re.split(r"^\.SS ", self.page, flags=re.MULTILINE)
        of_command = {section.splitlines()[0]: section for section in sections[1:]}
        for name, options in commands():
            if not name or name == ("stress",):
                continue
            section = of_command.pop(" ".join(name)).replace("\\-", "-")
            for option in set(options) - {"--help"}:
                self.assertIn(f"\\fB{option}\\fR", section)
        self.assertEqual(of_command, {})

    def test_troff_has_nothing_to_say(self):
        if shutil.which("groff") is None:
            self.skipTest("groff is not installed")
        done = subprocess.run(["groff", "-man", "-ww", "-z", "-Tutf8"], input=self.page, capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")

    def test_an_unknown_shell(self):
        done = subprocess.run([PROGRAM, "completion", "tcsh"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("there is no completion for 'tcsh'; there are: bash, zsh, fish", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
