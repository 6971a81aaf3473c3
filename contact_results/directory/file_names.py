"""Names of the files of a run; other files in its directory are never changed."""

SUMMARY = "summary.json"
TIMING = "timing.json"
FIELDS = "result.h5"
PROFILES = "profiles.csv"
INCREMENTS = "increments.csv"
CYCLES = "cycles.csv"
COLUMNS = "columns.csv"
STRESS = "stress.json"  # summary of `slipstick stress`, in a directory of its own
STRESS_PAGE = "stress.html"

PAGE = "index.html"
OVERVIEW_FIGURE = "overview.png"
PRESSURE_FIGURE = "pressure.png"
SHEAR_FIGURE = "shear.png"
PROFILE_FIGURE = "profiles.png"
STICK_SLIP_FIGURE = "stick_slip.png"
SLIP_FIGURE = "slip.png"
DISSIPATION_FIGURE = "dissipation.png"
FRETTING_FIGURE = "fretting.png"

RUN_FILES = (
    SUMMARY,
    TIMING,
    FIELDS,
    PROFILES,
    INCREMENTS,
    CYCLES,
    COLUMNS,
    PAGE,
    OVERVIEW_FIGURE,
    PRESSURE_FIGURE,
    SHEAR_FIGURE,
    PROFILE_FIGURE,
    STICK_SLIP_FIGURE,
    SLIP_FIGURE,
    DISSIPATION_FIGURE,
    FRETTING_FIGURE,
)
