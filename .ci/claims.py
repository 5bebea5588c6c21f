"""Claims of a script: those that do not hold are printed and counted."""
failed = 0


def check(what, good, more=""):
    """`more` says what was seen instead."""
    global failed
    if not good:
        failed += 1
        print(f"FAILED  {what} {more}".rstrip())
