"""Pictures by gnuplot, which read on a light page and on a dark one."""
import subprocess

COLOURS = {"without": "#8a8f98", "with": "#2f80d0", "rest": "#8a8f98", "family": "#d9822b"}


def svg(path, size, commands):
    """Writes what gnuplot draws of `commands`. size: (width, height) in pixels"""
    head = (f'set terminal svg size {size[0]},{size[1]} dynamic enhanced font "sans-serif,13"\n'
            f'set output "{path}"\n'
            'set border 3 lc rgb "#8a8f98"\nset tics nomirror tc rgb "#8a8f98"\nset grid lc rgb "#808080" lw 0.3 dt 3\n'
            'set key tc rgb "#8a8f98"\nset title tc rgb "#8a8f98"\nset xlabel tc rgb "#8a8f98"\nset ylabel tc rgb "#8a8f98"\n')
    drawn = subprocess.run(["gnuplot"], input=head + commands, capture_output=True, text=True, check=False)
    if drawn.returncode or drawn.stderr.strip():
        raise SystemExit(f"glsum: docs: {path.name}: gnuplot: {drawn.stderr.strip()}")


def block(name, *columns):
    """A data block of gnuplot. Columns are equally long."""
    rows = "\n".join(" ".join(f"{value:.9g}" for value in row) for row in zip(*columns))
    return f"${name} << END\n{rows}\nEND\n"
