"""A page for each kernel family: what it promises, its bound, what it costs, an example in C++ and in C."""
import json

from . import draw, text

TITLE = "kernel families"
ORDER = 0.5
CORE = "stm32f746-itcm"
# Of a family the kernel that the C example is made of, and the options that say its length.
IN_C = {
    "window": "--kernel ring_plain_f32 --taps 400",
    "exponentials": "--kernel modes_plain_f32 --taps 2+9",
    "filter": "--kernel cascade_df2t_f32 --taps 2+9",
    "logmemory": "--kernel nested_plain_f32 --taps 32",
    "lookahead": "--kernel block_oldestfma_f32 --taps 400",
    "transposed": "--kernel transposed_oldest_f32 --taps 400",
}
PAGES = {
    "window": ("accuracy", "fast-loops"),
    "exponentials": ("full-memory", "histories", "derivative"),
    "filter": ("histories", "derivative"),
    "logmemory": ("full-memory", "histories"),
    "lookahead": ("histories", "fast-loops"),
    "transposed": ("histories", "fast-loops"),
}


def points(results):
    """Of each kernel at order 0.5 and each length: (name, taps, modelled cycles, largest error over the signals, bytes)."""
    errors, costs = {}, {}
    for row in json.loads(results.read_text())["benchmarks"]:
        words = row["name"].split("/")
        if words[0] != "gl" or words[2] != f"order:{ORDER}" or len(words) < 5 or not words[3].startswith("taps:"):
            continue
        key = (words[1], words[3].removeprefix("taps:"))
        if words[4] == "accuracy" and not any(word.startswith("amplitude:") for word in words) and "error_max" in row:
            errors[key] = max(errors.get(key, 0.0), row["error_max"])
        if words[-1] == f"m7:{CORE}" and "model_cycles_per_sample" in row:
            costs[key] = (row["model_cycles_per_sample"], row["state_bytes"] + row["coefficient_bytes"])
    return [(*key, costs[key][0], errors[key], costs[key][1]) for key in costs if errors.get(key, 0.0) > 0.0]


def _picture(word, names, all_points, path):
    mine = [point for point in all_points if point[0] in names]
    rest = [point for point in all_points if point[0] not in names]
    draw.svg(path, (560, 380), draw.block("rest", [one[2] for one in rest], [one[3] for one in rest]) +
             draw.block("mine", [one[2] for one in mine], [one[3] for one in mine]) + f"""
set logscale xy
set format y "10^{{%T}}"
set xlabel "modelled cycles a sample, {CORE}"
set ylabel "largest error of the sum"
set key outside top right horizontal
plot $rest with points pt 7 ps 0.35 lc rgb "{draw.COLOURS['rest']}" title "other families", \\
     $mine with points pt 7 ps 0.6 lc rgb "{draw.COLOURS['family']}" title "{word}"
""")


def _headers(source, word):
    """The comments of the family's headers: its histories first, then its ways of summing, then its bound."""
    folder = source / "kernels/glsum" / word
    paths = [path for path in sorted(folder.glob("*.hpp"))
             if not any(path.stem.endswith(end) for end in ("_body", "_sum", "_arch", "_product", "_chosen", "_architectures"))]
    bounds = [path for path in paths if path.stem.endswith("_bound")]
    return [path for path in paths if path not in bounds], bounds


def _page(family, source, all_points):
    word = family["word"]
    names = [kernel["name"] for kernel in family["kernels"]]
    headers, bounds = _headers(source, word)
    rows = [(f"`{one['name']}`", f"`{one['history']}`", f"`{one['technique']}`", f"`{one['format']}`", one["orders"],
             "host alone" if one["host_only"] else "software double" if one["in_double"] else "") for one in family["kernels"]]
    mine = sorted((point for point in all_points if point[0] in names), key=lambda point: point[2])
    front, best = [], float("inf")
    for point in mine:
        if point[3] < best:
            best = point[3]
            front.append(point)
    example = (source / f"docs/site/examples/{word}.cpp").read_text()
    said = (source / f"docs/site/examples/{word}.txt").read_text()
    said_by_c = (source / f"docs/site/examples/{word}-c.txt").read_text()
    in_c = (source / "docs/site/examples/half_derivative.c").read_text()
    parts = [
        f"# {word}\n",
        f"{family['keeps'][0].upper()}{family['keeps'][1:]}.\n",
        "More: " + ", ".join(f"[{name}](../docs/{name}.md)" for name in PAGES[word]) + ".\n",
        "## What it costs\n",
        f"At order {ORDER}, over 5000 samples: the largest error of the sum over seven signals, as a part of the largest exact sum. "
        f"Cycles are modelled for `{CORE}`; [how far they were from silicon](../docs/timing-model.md).\n",
        f"![Error against modelled cycles: {word}, and all other families]({word}.svg)\n",
        "The family's own front, by `./glsum bench --quick`:\n",
        text.table(("kernel", "taps", "cycles", "error", "bytes"),
                   [(f"`{name}`", taps, f"{cycles:.0f}", f"{error:.1e}", size) for name, taps, cycles, error, size in front]),
        "## Kernels\n",
        text.table(("kernel", "history", "technique", "format", "orders", ""), rows),
        "## In C++\n",
        text.code(example, "cpp"),
        "It prints:\n",
        text.code(said),
        "## In C99\n",
        text.code(f"./glsum generate --order {ORDER} --step-s 0.001 {IN_C[word]} --out half_derivative.h\ncc -O2 -I. half_derivative.c -lm"),
        text.code(in_c, "c"),
        "It prints:\n",
        text.code(said_by_c),
        "## What it promises\n",
    ]
    for path in headers:
        comment = text.head_comment(path)
        if comment:
            parts.append(f"### {path.stem}\n\n" + text.code(comment))
    parts.append("## Its error bound\n")
    if not bounds:
        parts.append("It sums a window's terms, and has [the window's bound](window.md).\n")
    for path in bounds:
        parts.append(text.code(text.head_comment(path)))
    return "\n".join(parts)


def write(source, facts, tree):
    families = json.loads((facts / "families.json").read_text())
    all_points = points(facts / "run.json")
    folder = tree / "families"
    folder.mkdir()
    for family in families:
        word = family["word"]
        _picture(word, {kernel["name"] for kernel in family["kernels"]}, all_points, folder / f"{word}.svg")
        (folder / f"{word}.md").write_text(_page(family, source, all_points))
    rows = [(f"[{one['word']}]({one['word']}.md)", one["keeps"], len(one["kernels"])) for one in families]
    (folder / "index.md").write_text(
        "# Kernel families\n\nA kernel is a history, a technique and a format. Histories that keep the past in one way are a family. "
        "[The words](../kernels/README.md), and [what is not there and why](../docs/kernels.md).\n\n" +
        text.table(("family", "what it keeps", "kernels"), rows) + "\n" + text.toctree([one["word"] for one in families]))
