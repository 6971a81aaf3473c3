"""Open challenge: problems that other contact codes solve and send back as files or functions.

Answers of all codes, including ours, are judged by the same error bounds.
"""
