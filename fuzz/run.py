"""`python fuzz/run.py TARGET --seconds 600`: atheris on one target, coverage-guided.

Needs atheris beside the project (docs/fuzzing.md); a finding ends it with status 1 and leaves the
input under out/fuzz/TARGET/.
"""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIMIT_MB = 1024
"""Resident memory; a target that needs more has none of its bounds."""
NUMERIC = ["hil.cell.sensor.hysteresis", "hil.cell.sensor.transducer"]
"""Left plain: atheris 3.0 leaks the operands of each comparison of two arrays, a gigabyte in 40,000
inputs, and they read no bytes of a client's."""
HANG = 20
"""Seconds that one input may take; the interpreter runs ten times slower when instrumented."""


def main() -> None:
    sys.path.insert(0, str(ROOT))
    try:
        import atheris  # noqa: PLC0415  not among the project's dependencies
    except ImportError:
        sys.exit("atheris is missing: pip install --target .fuzz atheris; PYTHONPATH=.fuzz")
    with atheris.instrument_imports(include=["drivers", "hil"], exclude=NUMERIC):
        from fuzz.targets import TARGETS  # noqa: PLC0415
    asked = _arguments(sorted(TARGETS))
    target, folder = TARGETS[asked.target], ROOT / "out/fuzz" / asked.target
    corpus = folder / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for number, seed in enumerate(target.seeds):
        (corpus / f"seed-{number}").write_bytes(seed)
    options = [
        f"-max_total_time={asked.seconds}", f"-rss_limit_mb={LIMIT_MB}", f"-timeout={HANG}",
        f"-seed={asked.seed}", f"-artifact_prefix={folder}/", "-print_final_stats=1",
    ]  # fmt: skip
    if target.words:
        words = folder / "words"
        words.write_text("".join(f'"{_escaped(word)}"\n' for word in target.words))
        options.append(f"-dict={words}")
    atheris.Setup([sys.argv[0], *options, str(corpus)], target.check)
    atheris.Fuzz()


def _arguments(names: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Fuzz one decoder or interpreter.")
    parser.add_argument("target", choices=names, metavar="TARGET", help=", ".join(names))
    parser.add_argument("--seconds", type=int, default=600, help="how long (default: 600)")
    parser.add_argument("--seed", type=int, default=1, help="of the mutations; 0 draws one")
    return parser.parse_args()


def _escaped(word: bytes) -> str:
    return "".join(f"\\x{octet:02x}" for octet in word)


if __name__ == "__main__":
    main()
