"""Open challenge: other codes solve the verification problems and are judged by equal criteria."""
