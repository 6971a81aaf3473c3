"""Names of the files of a run; other files in its directory are never changed."""

SUMMARY = "summary.json"
TIMING = "timing.json"
FIELDS = "result.h5"
PROFILES = "profiles.csv"
INCREMENTS = "increments.csv"
CYCLES = "cycles.csv"
COLUMNS = "columns.csv"
INPUTS = "inputs.json"
STRESS = "stress.json"  # summary of `slipstick stress`, in a directory of its own
STRESS_PAGE = "stress.html"

PAGE = "index.html"
OVERVIEW_FIGURE = "overview.png"
FIGURES = (
    OVERVIEW_FIGURE,
    *("pressure.png", "shear.png", "profiles.png", "stick_slip.png"),
    *("slip.png", "dissipation.png", "fretting.png"),
)

RUN_FILES = (SUMMARY, TIMING, FIELDS, PROFILES, INCREMENTS, CYCLES, COLUMNS, INPUTS, PAGE, *FIGURES)
