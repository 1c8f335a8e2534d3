"""Hostile versions of good files: scenarios by their structure, other text and binary files by bytes and fields.

Every function takes a `random.Random` and returns a new content; the same generator state gives the same content.
"""

import random
import re

import yaml

NUMBERS = ["0", "-0", "-1", "1", "1e-320", "5e-324", "2.3e-308", "1e-300", "1e-162", "1e-15", "1e-9", "1e-6", "1e-3", "0.5", "0.9999999999999999",
           "1.0000000000000002", "2", "3", "7", "100", "1e3", "1e6", "1e9", "1e12", "1e15", "9007199254740993", "2147483648", "4294967296",
           "18446744073709551616", "1e100", "1e154", "1e200", "1e300", "1.7976931348623157e308", "1e308", "-1e308", "1e309", "1e-400", "nan",
           "inf", "-inf", ".inf", ".nan", "0x10", "010", "1_000", "1,5", "+1", "1.", ".5", "1e", "--1", "١", "1e99999999999", "0" * 400, "9" * 400]
UNITS = ["", "m", "mm", "um", "kg", "g", "N", "kN", "N/m", "N.s/m", "Hz", "rpm", "rad/s", "deg", "s", "ms", "1/s", "m/s", "m/s^2", "m^0.5", "degC", "%", "lb",
         "m" * 300, "kg.m.s.A.K.mol.cd", "m^999999999999", "(((((m", "m/0", "µm", "Ω", "N/m ± 5 %", "kg +- 1e308 kg", "@", "\\", "'", "dB", "m m m m"]
WORDS = ["", "~", "null", "true", "no", "[]", "{}", "[[[[]]]]", "{a: {b: {c: {}}}}", "natural", "damped", "ground", "base", "log", "linear", "none", "coulomb",
         "*a", "&a x", "!!python/object/apply:os.system [ls]", "<<: 1", "'open", '"open', "/etc/passwd", "../../../../etc/passwd", "file:///etc/passwd",
         "|\n  block", ">-\n  folded", "\x00", "\u202e", "\ufeff", "a" * 5000, "%n%s%x", "$(id)", "`id`", "<script>alert(1)</script>", "]]>", "-->", "\U0001f600",
         "{from: 1, to: 0, count: 5}", "{from: 0, to: 0, count: 1}", "{from: 1e-300, to: 1e300, count: 9, spacing: log}", "{from: 0, to: 1, count: 1e12}",
         "{from: 0, to: 1, count: -1}", "[1, 1, 1]", "[1, -1]", "[" + "1, " * 3000 + "1]", "[" * 200 + "]" * 200, "{from: 1 Hz, to: 9 Hz, count: 3}"]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")


def spans(text):
    """(start, end, kind, path) of every value of a YAML text; a pair has the kind 'pair' and reaches from key to value."""
    found = []

    def walk(node, path):
        found.append((node.start_mark.index, node.end_mark.index, node.id, path))
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                name = path + (str(key.value),)
                found.append((key.start_mark.index, value.end_mark.index, "pair", name))
                found.append((key.start_mark.index, key.end_mark.index, "key", name))
                walk(value, name)
        elif isinstance(node, yaml.SequenceNode):
            for item in node.value:
                walk(item, path + ("[]",))

    root = yaml.compose(text, Loader=yaml.CSafeLoader)
    if root is not None:
        walk(root, ())
    return found


def hostile_number(random_, old):
    """Another number in the place of `old`, often one that is still sensible."""
    choice = random_.random()
    if choice < 0.35:
        return random_.choice(NUMBERS)
    try:
        value = float(old)
    except ValueError:
        return random_.choice(NUMBERS)
    if choice < 0.65:
        value *= 10.0 ** random_.uniform(-12, 12)
    elif choice < 0.9:
        value *= random_.choice([0.1, 0.5, 0.9, 1 - 1e-15, 1 + 1e-15, 1.1, 2, 10, -1])
    else:
        return str(int(value) + random_.choice([-1, 1])) if abs(value) < 1e15 else "1"
    return f"{value:.{random_.choice([3, 6, 17])}g}"


class Corpus:
    """Good scenarios, and what their parts can be exchanged for."""

    def __init__(self, texts):
        self.texts = texts
        self.parts = {}
        self.keys = set()
        for text in texts:
            for start, end, kind, path in spans(text):
                if kind == "key":
                    self.keys.add(path[-1])
                elif kind != "pair" and path and path[-1] != "[]":
                    flow = flow_text(text[start:end], kind)
                    if flow is not None and len(flow) < 2000:
                        self.parts.setdefault(path[-1], []).append(flow)
        self.keys = sorted(self.keys)

    def mutant(self, random_, text):
        for _ in range(random_.choice([1, 1, 1, 2, 2, 3, 5])):
            try:
                found = spans(text)
            except (yaml.YAMLError, RecursionError, ValueError):
                break
            text = self.mutate_once(random_, text, found)
        if random_.random() < 0.08:
            text = damaged(random_, text.encode("utf-8", "surrogatepass")).decode("utf-8", "replace")
        return text

    def mutate_once(self, random_, text, found):
        kind = random_.choice(["number"] * 6 + ["part"] * 5 + ["word", "unit", "delete", "delete", "double", "rename", "add"])
        if kind == "number":
            chosen = [s for s in found if s[2] == "scalar" and NUMBER.match(text[s[0]:s[1]])]
        elif kind == "part":
            chosen = [s for s in found if s[2] not in ("pair", "key") and s[3] and s[3][-1] in self.parts]
        elif kind in ("word", "unit"):
            chosen = [s for s in found if s[2] == "scalar"]
        elif kind in ("delete", "double", "add"):
            chosen = [s for s in found if s[2] == "pair"]
        else:
            chosen = [s for s in found if s[2] == "key"]
        if not chosen:
            return text
        start, end, what, path = random_.choice(chosen)
        old = text[start:end]
        if kind == "number":
            new = NUMBER.sub(lambda match: hostile_number(random_, match.group()), old, count=1)
        elif kind == "part":
            new = random_.choice(self.parts[path[-1]])
        elif kind == "word":
            new = random_.choice(WORDS)
        elif kind == "unit":
            new = (NUMBER.match(old) or [random_.choice(NUMBERS)])[0] + " " + random_.choice(UNITS)
        elif kind == "delete":
            rest = text[end:]
            return text[:start].rstrip(" ") + (rest.lstrip(" ,") if rest.lstrip(" ").startswith(",") else rest)
        elif kind == "double":
            new = old + (", " if "\n" not in old else "\n") + old
        elif kind == "add":
            name = random_.choice(self.keys)
            value = random_.choice(self.parts.get(name, WORDS))
            indent = start - (text.rfind("\n", 0, start) + 1)
            is_block = not text[start - indent:start].strip()
            new = f"{name}: {value}\n{' ' * indent}{old}" if is_block else f"{name}: {value}, {old}"
        else:
            new = random_.choice(self.keys)
        return text[:start] + new + text[end:]


def flow_text(text, kind):
    """A part of a scenario on one line, so that it fits anywhere; None where it does not parse."""
    if kind == "scalar":
        return None if "\n" in text else text
    try:
        return on_one_line(yaml.load(text, Loader=yaml.CBaseLoader))
    except yaml.YAMLError:
        return None


def on_one_line(value):
    """The YAML of maps, lists and texts."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {on_one_line(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(on_one_line, value)) + "]"
    return f'"{value}"' if re.search(r"[,:{}\[\]#]", value) else value


# What a scenario says of its rig. Other sections say what is computed.
RIG_SECTIONS = ("system", "excitation", "initial")
# Numbers that are no sizes.
KEPT = {"count", "exponent", "file", "interpolation", "law", "order", "seed", "type"}


def neighbour(random_, text):
    """Another rig of the same kind: three of five numbers of a good scenario times 0.3 to 3, static at least kinetic friction.

    A scenario as maps, lists and texts.
    """
    scenario = yaml.load(text, Loader=yaml.CBaseLoader)
    # A title or an expected value speaks of the numbers as they were.
    kept = {key: value for key, value in scenario.items() if key not in ("title", "expect")}
    return kept | {key: resized(random_, kept[key]) for key in RIG_SECTIONS if key in kept}


def resized(random_, value):
    if isinstance(value, list):
        return [resized(random_, item) for item in value]
    if isinstance(value, dict):
        other = {key: item if key in KEPT else resized(random_, item) for key, item in value.items()}
        levels = [NUMBER.match(str(other.get(key))) for key in ("kinetic", "static")]
        if all(levels) and float(levels[1][0]) < float(levels[0][0]):
            other["static"] = other["kinetic"]
        return other
    if random_.random() < 0.4:
        return value
    return NUMBER.sub(lambda match: f"{float(match[0]) * 10 ** random_.uniform(-0.5, 0.5):.6e}", value, count=1) if NUMBER.match(value) else value


def damaged(random_, content):
    """Bytes changed, cut out, doubled or put in."""
    content = bytearray(content)
    for _ in range(random_.choice([1, 1, 2, 4, 16])):
        at = random_.randrange(len(content) + 1)
        kind = random_.randrange(6)
        if kind == 0 and at < len(content):
            content[at] ^= 1 << random_.randrange(8)
        elif kind == 1 and at < len(content):
            content[at] = random_.choice([0, 255, 10, 13, 34, 39, 44, 46, 45, random_.randrange(256)])
        elif kind == 2:
            del content[at:at + random_.choice([1, 2, 8, 100, 10**9])]
        elif kind == 3:
            content[at:at] = content[at:at + random_.choice([1, 8, 80, 800])] * random_.choice([1, 2, 50])
        elif kind == 4:
            content[at:at] = bytes(random_.randrange(256) for _ in range(random_.choice([1, 4, 16])))
        else:
            content[at:at] = random_.choice(NUMBERS + WORDS).encode("utf-8", "replace")
    return bytes(content)


def mutated_table(random_, content):
    """A text of numbers with some of them hostile, or with damaged bytes."""
    if random_.random() < 0.4:
        return damaged(random_, content)
    text = content.decode("utf-8", "replace")
    places = list(NUMBER.finditer(text))
    for match in sorted(random_.sample(places, min(len(places), random_.choice([1, 1, 2, 5, 40]))), key=lambda m: -m.start()):
        text = text[:match.start()] + hostile_number(random_, match.group()) + text[match.end():]
    if random_.random() < 0.3:
        lines = text.split("\n")
        at = random_.randrange(len(lines))
        lines[at:at] = random_.choice([[lines[at]], [""], lines[:2], [random_.choice(WORDS)], [lines[random_.randrange(len(lines))]] * 30])
        text = "\n".join(lines)
    if random_.random() < 0.2:
        text = text.replace(*random_.choice([(",", ";"), (",", "\t"), ("\n", "\r"), ("\n", "\r\n"), (".", ","), ("[", "("), (" ", "\u00a0"), ("1", "")]))
    return text.encode("utf-8", "replace")
