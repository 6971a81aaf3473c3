"""The files a run may leave in its directory; nothing else there is ever touched."""

SUMMARY = "summary.json"
TIMING = "timing.json"
FIELDS = "result.h5"
PROFILES = "profiles.csv"
INCREMENTS = "increments.csv"

PRESSURE_FIGURE = "pressure.png"
SHEAR_FIGURE = "shear.png"
PROFILE_FIGURE = "profiles.png"
STICK_SLIP_FIGURE = "stick_slip.png"
LOADING_FIGURE = "loading_curve.png"
HYSTERESIS_FIGURE = "hysteresis.png"

RUN_FILES = (
    SUMMARY,
    TIMING,
    FIELDS,
    PROFILES,
    INCREMENTS,
    PRESSURE_FIGURE,
    SHEAR_FIGURE,
    PROFILE_FIGURE,
    STICK_SLIP_FIGURE,
    LOADING_FIGURE,
    HYSTERESIS_FIGURE,
)
