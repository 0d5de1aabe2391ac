"""Integrators in a program that is asked line by line: the library's (../examples/timed) and
the peers written in Rust (rust/src/main.rs)."""

import json
import subprocess


class Program:
    def __init__(self, path):
        self.process = subprocess.Popen(
            [path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def ask(self, *words):
        self.process.stdin.write(" ".join(map(str, words)) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if isinstance(answer, dict) and "error" in answer:
            raise RuntimeError(answer["error"])
        return answer

    def describe(self, problem):
        return self.ask("describe", problem)

    def schemes(self):
        """The names of the integrators that take a tolerance."""
        return [scheme["name"] for scheme in self.ask("schemes") if scheme["adaptive"]]

    def integrator(self, problem, scheme, value, control="tolerance"):
        """A function of an end time and a number of repeats that gives a run."""

        def run(t_end, repeats):
            words = (problem, scheme, f"{control}={value!r}", repr(t_end), repeats)
            answer = self.ask("run", *words)
            return answer["seconds"], answer["x"], answer["transitions"], answer["steps"]

        return run
