"""The paper's claim that a coated contact slides grossly at 0.76 µW, and its tractions before."""
