#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Halfshadow authors
"""What the open compilers of mobile GPUs make of the programs that the engine draws with.

    compile.py [--programs PATH] [--compilers DIR] [--gpus NAME,NAME...|key|all] [--write FILE] [--work DIR]

PATH: the program mobile_programs (default: build/bin/mobile_programs beside this repository's sources). DIR: a folder in
which compilers of these GPUs were built from Mesa under its drm-shim, with compile_on_gpus.py in it (default: the
environment variable HALFSHADOW_MOBILE_COMPILERS). For each GPU the programs of its rung at default settings, or with the
choices of the device profile that limits.json names for it, are compiled;
those that its driver would leave out are left out under the engine as well, whose fallbacks are then compiled, until
nothing is dropped. Prints counts per technique and path, and of some programs with loops what
a fragment executes, and checks them against limits.json beside this file.
FILE: gets the counts as JSON. Counts are compiled, not measured: nothing is drawn on a GPU.
Exit status: 0 within the limits, 1 beyond, 77 without compilers."""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
NOTE = ("Compiled, not measured, by Mesa's open compilers, of one receiver pixel with 8-bit visibility at default settings and "
        "with the GPU's own fallbacks, of Mali-4xx with the choices of its device profile. Mali-400: words; VideoCore IV: instructions/estimated cycles, threads; Mali-T: bundles, "
        "registers, threads; Mali-G: instructions, cycles, threads; Adreno 2xx: alu + tex, registers; other Adreno: "
        "instructions, full/half registers, waves; Vivante: instructions, registers. L: loops, of which one turn is counted; "
        "S: spills and fills.")
TITLES = {"mali400": "Mali-400", "vc4": "VideoCore IV", "mali-t860": "Mali-T860", "mali-g31": "Mali-G31",
          "adreno220": "Adreno 220", "adreno305": "Adreno 305", "adreno530": "Adreno 530", "gc2000": "GC2000"}
MOST_ROUNDS = 16  # more than any ladder of fallbacks has steps


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", default=os.path.join(HERE, "../../build/bin/mobile_programs"))
    parser.add_argument("--compilers", default=os.environ.get("HALFSHADOW_MOBILE_COMPILERS", ""))
    parser.add_argument("--gpus", default="key")
    parser.add_argument("--write")
    parser.add_argument("--work")
    return parser.parse_args()


def say(text):
    print(text, file=sys.stderr, flush=True)


class Gpu:
    """The programs that the engine ends up with on one GPU, and their counts."""

    def __init__(self, name, rung, options, tools, work, chosen=()):
        self.name, self.rung, self.options, self.tools, self.chosen = name, rung, options, tools, chosen
        self.folder = os.path.join(work, name)
        os.makedirs(self.folder, exist_ok=True)
        self.dropped, self.results, self.programs, self.first_dropped = set(), {}, {}, []

    def list_programs(self):
        if not self.dropped:  # the same for all GPUs of a rung that have no choices of their own
            shared = os.path.join(os.path.dirname(self.folder), "-".join([self.rung, *self.chosen]))
            if not os.path.exists(os.path.join(shared, "programs.tsv")):
                subprocess.run([self.options.programs, shared, self.rung, *self.chosen], check=True,
                               stderr=subprocess.DEVNULL)
            self.read_programs(shared)
            return
        path = os.path.join(self.folder, "dropped")
        with open(path, "w") as file:
            file.writelines(identifier + "\n" for identifier in sorted(self.dropped))
        subprocess.run([self.options.programs, self.folder, self.rung, "--dropped", path, *self.chosen], check=True,
                       stderr=subprocess.DEVNULL)
        self.read_programs(self.folder)

    def read_programs(self, folder):
        self.listed = folder
        with open(os.path.join(folder, "programs.tsv")) as file:
            lines = [line.rstrip("\n").split("\t") for line in file]
        self.programs = {line[0]: line for line in lines}

    def compile(self):
        worker = self.tools.Worker(self.name)
        for identifier, line in self.programs.items():
            if identifier in self.results:
                continue
            status, output = worker.run(identifier, line[1], line[2], line[3])
            self.results[identifier] = self.tools.parse(self.name, status, output)
        worker.close()
        return {i for i in self.programs if self.results[i]["status"] != "ok"} - self.dropped

    def settle(self):
        for turn in range(MOST_ROUNDS):
            self.list_programs()
            new = self.compile()
            say(f"{self.name}: {len(self.programs)} programs, {len(new)} that its driver leaves out")
            if turn == 0:
                self.first_dropped = sorted({self.label(i) for i in new})
            if not new:
                return True
            self.dropped |= new
        return False

    def label(self, identifier):
        line = self.programs[identifier]
        return " ".join(line[5].split()) + " " + line[3]

    def cell(self, identifier):
        return self.tools.cell(self.name, self.results[identifier])

    def fallbacks(self):
        with open(os.path.join(self.listed, "fallbacks.tsv")) as file:
            taken = {}
            for line in file:
                technique, _, _, what, why = line.rstrip("\n").split("\t")
                taken.setdefault(technique, []).append(what.split()[-1] + ": " + why.split("on this device: ")[-1])
        return {technique: sorted(set(steps)) for technique, steps in taken.items()}


def numbers(gpu, identifier):
    """Named counts of a program, for limits."""
    fragment = gpu.results[identifier]["fs"] or {}
    names = {"i": "instructions", "cyc": "cycles", "thr": "threads", "spills": "spills", "r": "registers"}
    return {name: fragment[key] for key, name in names.items() if key in fragment}


def choices(name, limits):
    """KEY=VALUE of the device profile that a GPU's programs are counted with."""
    profiles = [file for pattern, file in limits["profiles"].items() if re.fullmatch(pattern, name)]
    if not profiles:
        return []
    with open(os.path.join(HERE, "../../profiles/devices", profiles[0])) as file:
        return [setting["key"] + "=" + setting["value"] for setting in json.load(file)["settings"]]


def violations(gpu, limits):
    found = []
    for rule in limits["programs"]:
        for identifier in gpu.programs:
            label = gpu.label(identifier)
            if gpu.name not in rule["limits"] or not re.search(rule["match"], label) or identifier in gpu.dropped:
                continue
            if "but" in rule and re.search(rule["but"], label):
                continue
            counts = numbers(gpu, identifier)
            for name, limit in rule["limits"][gpu.name].items():
                value = counts.get(name, 0)
                beyond = value < limit if name == "threads" else value > limit
                if beyond:
                    found.append(f"{gpu.name}: {label}: {value} {name}, the limit is {limit}")
    for rule in limits["executed"]:
        if gpu.name not in rule["limits"]:
            continue
        counts = executed(gpu, rule)
        if not counts:
            found.append(f"{gpu.name}: no program is {rule['match']}")
        for label, count in counts.items():
            print(f"{gpu.name}: {label}: {count} executed")
            if count > rule["limits"][gpu.name]:
                found.append(f"{gpu.name}: {label}: {count} executed, the limit is {rule['limits'][gpu.name]}")
    return found


def repeated(text, function, times):
    """The program with the body of a function's first loop written so many times, wherever the function is defined:
    which definition counts, the preprocessor knows."""
    # Where the preprocessor chooses among headers, the body follows the last.
    header = re.compile(r"for \((?:HS_HIGHP )?int \w+ = 0; [^{]*\{\n(?:#else\n *for [^{]*\{\n#endif\n)?")
    heads = list(re.finditer(r"^[A-Za-z][^\n;]*\b" + function + r"\([^;{]*\{", text, re.M))
    for head in reversed(heads):
        begin = end = header.search(text, head.end()).end()
        depth = 1
        while depth > 0:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        # Turns that follow each other: compilers merge equal ones.
        bodies = ["{" + text[begin:end - 1].replace("float(i)", f"(float(i) + {turn}.0)") + "}\n" for turn in range(times)]
        text = text[:begin] + "".join(bodies) + text[end - 1:]
    return text


class Sizes:
    """Of programs that are no others than a GPU's own with some lines written again."""

    def __init__(self, gpu, folder):
        self.gpu, self.folder = gpu, folder
        self.worker = gpu.tools.Worker(gpu.name)

    def of(self, line, text):
        path = os.path.join(self.folder, "repeated.frag")
        with open(path, "w") as file:
            file.write(text)
        status, output = self.worker.run("repeated", line[1], path, line[3])
        result = self.gpu.tools.parse(self.gpu.name, status, output)
        return result["fs"]["i"] if result["status"] == "ok" else float("inf")

    def executed(self, line, turns):
        """Counts have one turn of each loop; a turn takes half of what three in a row take more than one."""
        with open(line[2]) as source:
            text = source.read()
        total = self.of(line, text)
        for function, count in turns.items():
            total += (count - 1) * (self.of(line, repeated(text, function, 3)) - self.of(line, text)) // 2
        return total


def executed(gpu, rule):
    """What a fragment runs, by label."""
    folder = os.path.join(gpu.folder, "executed")
    # Of what is set twice the last counts.
    subprocess.run([gpu.options.programs, folder, gpu.rung, "--scenes", rule["scene"], *gpu.chosen, *rule["settings"]],
                   check=True, stderr=subprocess.DEVNULL)
    sizes = Sizes(gpu, folder)
    found = {}
    with open(os.path.join(folder, "programs.tsv")) as file:
        for line in (text.rstrip("\n").split("\t") for text in file):
            label = " ".join(line[5].split()) + " " + line[3]
            if re.search(rule["match"], label) and not re.search(rule["but"], label):
                found[label] = sizes.executed(line, rule["turns"])
    sizes.worker.close()
    return found


def path_of(label):
    """Which path of a receiver pixel a program is, or None of one that fills maps."""
    if "PHASE_CLASSIFY" in label:
        return "lit or umbra"
    if "PHASE_FILTER" in label:
        return "penumbra, after it"
    if label.startswith("list/own_"):
        return "on the screen"
    return "every pixel" if re.match(r"(map/(hard|pcf|pcss|vsm)|list/|occlusion/occlusion_textures|width/shadow|screen/s)",
                                     label) else None


def table(gpus):
    """The largest of a path's programs, where scenes ask for several."""
    rows = {}
    for gpu in gpus:
        for identifier, line in gpu.programs.items():
            label = gpu.label(identifier)
            path = path_of(label)
            if path is None or identifier in gpu.dropped or "SHADED" in label:
                continue
            casting = "casting" if "CASTING_RECEIVER" in label or path == "on the screen" else ""
            size = (gpu.results[identifier]["fs"]["i"], gpu.cell(identifier))
            for technique in line[4].split(","):
                cells = rows.setdefault((technique, path, casting), {})
                cells[gpu.name] = max(cells.get(gpu.name, (0, "-")), size)
    return {key: {name: cell for name, (_, cell) in cells.items()} for key, cells in rows.items()}


def text_of(document):
    """JSON with a line for each row of the table."""
    rows = ",\n".join("  " + json.dumps(row) for row in document["counts"])
    others = json.dumps(document | {"counts": []}, indent=1)
    return others.replace('"counts": []', '"counts": [\n' + rows + "\n ]", 1) + "\n"


def main():
    options = arguments()
    if not os.path.exists(os.path.join(options.compilers, "ready")):
        print("skipped: no compilers of mobile GPUs; set HALFSHADOW_MOBILE_COMPILERS to the folder they were built in")
        return 77
    sys.path.insert(0, options.compilers)
    import compile_on_gpus as tools
    with open(os.path.join(HERE, "limits.json")) as file:
        limits = json.load(file)
    names = {"key": tools.KEY, "all": list(tools.GPUS)}.get(options.gpus) or options.gpus.split(",")
    rung_of = lambda name: next(rung for pattern, rung in limits["rungs"].items() if re.fullmatch(pattern, name))
    wrong = []
    with tempfile.TemporaryDirectory() as scratch:
        gpus = [Gpu(name, rung_of(name), options, tools, options.work or scratch, choices(name, limits))
                for name in names]
        for gpu in gpus:
            if not gpu.settle():
                wrong.append(f"{gpu.name}: programs are dropped after {MOST_ROUNDS} rounds of fallbacks")
            wrong += violations(gpu, limits)
        rows = table(gpus)
        taken = {gpu.name: gpu.fallbacks() for gpu in gpus}
    print(NOTE)
    print("\t".join(["technique", "path", "receivers"] + names))
    for key in sorted(rows):
        print("\t".join(list(key) + [rows[key].get(name, "-") for name in names]))
    for name in names:
        for technique, steps in taken[name].items():
            print(f"{name}: {technique} -> {'; '.join(steps)}")
    if options.write:
        with open(options.write, "w") as file:
            file.write(text_of({"note": NOTE,
                                "columns": [{"gpu": name, "title": TITLES.get(name, name)} for name in names],
                                "counts": [{"technique": t, "path": p, "receivers": r or "all others", "counts": cells}
                                           for (t, p, r), cells in sorted(rows.items())],
                                "fallbacks": taken}))
    for line in wrong:
        print("beyond the limits: " + line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
