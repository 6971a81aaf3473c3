"""Where the error of a case comes from: each choice refined while the others stay."""
