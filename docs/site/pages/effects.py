"""A page for each effect that the diagnosis looks for: its equation, how it looks in a log, what it is confused with."""
import json
import math

from . import draw, text

TITLE = "effects"
PLACES = {
    "command": "on the command's way to the actuator",
    "actuator": "in the actuator",
    "plant": "in the plant's equation of motion",
    "output": "between the output and the sensor",
    "sensor": "in the sensor",
    "logger": "in the logger",
    "deployed": "in the simulation that ran",
}


def _rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def _change(effect):
    """rms of what the log changes by, over the deviation of the output."""
    mean = sum(effect["without"]) / len(effect["without"])
    change = _rms([one - other for one, other in zip(effect["with"], effect["without"])])
    return change / _rms([value - mean for value in effect["without"]])


def _picture(effect, path):
    change = [one - other for one, other in zip(effect["with"], effect["without"])]
    most = max(map(abs, change)) or 1.0
    draw.svg(path, (560, 420), draw.block("log", effect["time_s"], effect["input"], effect["without"], effect["with"], change) + f"""
set multiplot
set lmargin 8
set rmargin 2
set xrange [{effect['time_s'][0]}:{effect['time_s'][-1]}]
set format x ""
set tmargin 0
set bmargin 0
set origin 0,0.42
set size 1,0.5
set key outside top right horizontal
set ylabel "output"
plot $log using 1:3 with lines lw 1.5 lc rgb "{draw.COLOURS['without']}" title "without", \\
     $log using 1:4 with lines lw 1.5 lc rgb "{draw.COLOURS['with']}" title "with {effect['name'].replace('_', ' ')}"
set origin 0,0.25
set size 1,0.14
unset key
set ylabel "change" offset 1,0
set yrange [{-1.1 * most}:{1.1 * most}]
set ytics ({most:.1g}, 0, {-most:.1g})
plot $log using 1:5 with lines lw 1.5 lc rgb "{draw.COLOURS['with']}"
set origin 0,0.13
set size 1,0.10
set autoscale y
set ytics (0, 1)
set format x "%g"
set xlabel "time in s" offset 0,0.6
set ylabel "input"
plot $log using 1:2 with steps lw 1.5 lc rgb "{draw.COLOURS['without']}"
unset multiplot
""")


def _numbers(effect):
    if not effect["parameters"]:
        return "It has no number: that it is there is all.\n"
    rows = [(f"`{name}`", text.number(value), {"": "", "1": "1"}.get(effect["units"][name], effect["units"][name]))
            for name, value in effect["parameters"].items()]
    shown = {"effect": effect["name"],
             "parameters": {name: value if isinstance(value, str) else json.loads(text.number(value))
                            for name, value in effect["parameters"].items()}}
    return (text.table(("number", "in the picture", "unit"), rows) +
            "\nThe unit `u` is the input's, `y` the output's, `rhs` that of gain times input. "
            "In a model's file, for `./glsum simulate`:\n\n" + text.code(f'"effects": [{json.dumps(shown)}]', "json"))


def _confused(effect):
    if effect["moves_nothing"]:
        return "It moves no reading: it makes noise uneven, where the output moves fast. Its likelihood tells it.\n"
    note = ("A fitted base takes this effect up itself: it is told from a given model alone.\n\n" if effect["base_takes_it"] else
            "What a fitted base takes up itself (gain, time scale, dead time, offset) is taken out of both first.\n\n")
    if not effect["alike"]:
        return note + "In this record no other effect changes the log nearly alike (cosine of at least 0.8).\n"
    rows = [(f"[`{name}`]({name}.md)", f"{cosine:.2f}") for name, cosine in effect["alike"]]
    return (note + "Effects that change this record nearly alike, by the cosine between both changes. At 1.00 the record cannot part "
            "them; `diagnose` then answers `ambiguous`, with the experiment that does.\n\n" + text.table(("effect", "cosine"), rows))


def _page(effect, source):
    traits = [f"It acts {PLACES[effect['place']]}."]
    if len(effect["domains"]) < 4:
        traits.append(f"It occurs in {' and '.join(effect['domains'])} plants.")
    if effect["event"]:
        traits.append("It is an event: located afresh in each record.")
    if effect["linear"]:
        traits.append("It is linear and the same at all times, so a base of another form takes it up.")
    change = _change(effect)
    looks = (f"Simulated on {effect['plant']}. " +
             ("No reading moves.\n" if effect["moves_nothing"] else f"The log changes by {100 * change:.2g} % of the output's deviation.\n"))
    return "\n".join([
        f"# {effect['name']}\n",
        " ".join(traits) + "\n",
        "## Equation\n",
        text.code(text.head_comment(source / "gap/drive/effects" / f"{effect['name']}.cpp")),
        "## How it looks in a log\n",
        looks,
        f"![Output with and without {effect['name']}, their difference, and the input]({effect['name']}.svg)\n",
        _numbers(effect),
        "## What it is confused with\n",
        _confused(effect),
        "What the diagnosis answered for rigs with this effect: [named](../docs/measured/diagnosis-named.md), "
        "[withheld](../docs/measured/diagnosis-withheld.md).\n",
    ])


def write(source, facts, tree):
    effects = json.loads((facts / "effects.json").read_text())
    folder = tree / "effects"
    folder.mkdir()
    for effect in effects:
        _picture(effect, folder / f"{effect['name']}.svg")
        (folder / f"{effect['name']}.md").write_text(_page(effect, source))
    parts = ["# Effects\n\nWhat a simulation may lack, and `./glsum diagnose` looks for. "
             "[A walk](../docs/tutorials/rig.md) walks through one; [the method](../docs/diagnosis.md) says how it decides.\n"]
    for place, words in PLACES.items():
        rows = [(f"[`{one['name']}`]({one['name']}.md)", ", ".join(f"`{name}`" for name in one["parameters"]),
                 ", ".join(f"`{name}`" for name, _ in one["alike"][:3]))
                for one in effects if one["place"] == place]
        if rows:
            parts.append(f"## {words[0].upper()}{words[1:]}\n\n" + text.table(("effect", "numbers", "looks like"), rows))
    (folder / "index.md").write_text("\n".join(parts) + "\n" + text.toctree([one["name"] for one in effects]))
