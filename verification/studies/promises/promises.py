"""What is promised: a row each."""

from __future__ import annotations

from verification.studies.promises import (
    kept,
    pages,
    paths,
    planted,
    processes,
    revolution,
    solvers,
    texts,
)
from verification.studies.promises.promise import Promise

PROMISES = {
    promise.name: promise
    for promise in (
        Promise(
            "lines", f"a mutated scene is read or refused by name within {texts.LONGEST:g} ms",
            "lines of a scene with every table changed, renamed, removed, doubled, exchanged",
            (1000, 10_000), texts.lines_changed, "ms",
        ),
        Promise(
            "bytes", f"a mutated file is read or refused by name within {texts.LONGEST:g} ms",
            "bytes of that scene replaced, removed, put in",
            (1000, 20_000), texts.bytes_changed, "ms",
        ),
        Promise(
            "numbers", "an extreme number is refused by file and line, or means what it says",
            "NaN, ±Inf, negative, ±0, denormal, 1e±308 in every number of a scene",
            (261, 261), texts.numbers_changed, "ms",
        ),
        Promise(
            "bombs", f"a size bomb is refused within {texts.SOON:g} CPU s and "
            f"{texts.MOST_MEMORY:g} MiB",
            "scene files of 100 MB, of 9 MB in one text, key, number or nesting",
            (3, len(texts.BOMBS)), texts.bombs, "MiB",
        ),
        Promise(
            "absurd", f"a plan is answered or refused within {processes.LONGEST:g} CPU s",
            "films of E1/E2 1e±3, 1e±6 and h/a 3e-3, 1, 1e±12, ν near -1, 50 layers, by solver",
            (8, 76), processes.planned, "CPU s",
        ),
        Promise(
            "paths", "a name that leads elsewhere is refused; nothing there is opened or written",
            "names with .., links, devices, drives, of height maps, friction maps, cases, studies",
            (60, 120), paths.escaping,
        ),
        Promise(
            "pages", "of payloads in a title 0 are run by the page, and 0 ask for anything",
            "40 kinds of script and request, each as the title; the page opened in Chromium",
            (6, 40), pages.shown,
        ),
        Promise(
            "symmetry", "the mirrored or turned problem has that answer, within "
            f"{solvers.ROUNDING:g}; where bodies couple, the tolerance {solvers.TOLERANCE:g}",
            "drawn ellipsoids and two pushes in drawn directions",
            (6, 60), solvers.symmetric, "of what is allowed",
        ),
        Promise(
            "moved", "the moved problem has that answer within what the tolerance on gaps leaves "
            "open of the pressure of a cell",
            "drawn rough surfaces, moved by some cells, at tolerances 1e-8, 1e-10 and 1e-12",
            (6, 60), solvers.moved, "of what is allowed",
        ),
        Promise(
            "turned", f"no direction is another than the others, within {revolution.WITHIN:g}",
            "contacts of revolution pushed along drawn lines, by finite elements at a tolerance of "
            "1e-10 and on radii",
            (6, 60), revolution.turned, "of what is allowed",
        ),
        Promise(
            "units", f"units change no answer by more than {revolution.WITHIN:g}",
            "lengths and moduli times 1e-6 to 1e6, by finite elements at a tolerance of 1e-10 and "
            "on radii",
            (6, 60), revolution.scaled, "of what is allowed",
        ),
        Promise(
            "scale", f"units change no answer by more than {solvers.ROUNDING:g}; where bodies "
            f"couple, the tolerance {solvers.TOLERANCE:g}",
            "lengths and moduli times 1e-6 to 1e6",
            (4, 40), solvers.scaled, "of what is allowed",
        ),
        Promise(
            "not-a-number", "a number that is none ends in an error, or changes the answer by "
            f"{planted.OPEN:g} tolerances at most",
            "NaN and ±Inf in a value that a transform or a factorisation gives back",
            (12, 60), planted.planted,
        ),
        Promise(
            "soak", f"cycles repeat within {solvers.DRIFT:g}, and memory grows by 1 % at most",
            "cycles of fretting with a checkpoint after each",
            (20, 1000), solvers.soak, "% more memory",
        ),
        Promise(
            "bits", "the same run gives the same bytes",
            "again in a fresh process, with one thread and two, by four solvers",
            (4, 16), processes.repeated,
        ),
        Promise(
            "memory", f"planned memory is within {100 * processes.WITHIN:g} % of the peak",
            "drawn scenes by four solvers, writing and figures included",
            (4, 40), processes.estimated, "% off",
        ),
        Promise(
            "kills", "a killed run goes on to the same bytes, and shows nothing incomplete",
            "SIGKILL at random times, by four solvers, five in a run",
            (5, 100), processes.killed,
        ),
        Promise(
            "interrupts", "an interrupted command ends with 130 and leaves nothing half done",
            "SIGINT to each command at random times",
            (13, 52), processes.interrupted,
        ),
        Promise(
            "workers", "a killed worker costs its case alone, and the case is named",
            "sweeps of four cases of which one kills its worker",
            (1, 8), kept.worker_killed,
        ),
        Promise(
            "damage", "a damaged file is named and not believed",
            "arrays of the cache, parts of checkpoints, records: cut, flipped, grown, foreign, "
            "with names in a pickle",
            (57, 57), kept.damaged,
        ),
    )
}  # fmt: skip
