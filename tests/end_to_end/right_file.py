"""A small job of some kind, its correct file, and whether a disturbed run has left that file or can be resumed to it."""

import launch
import map_contents

NAME = "job.h5"

# Open MPI removes them when it closes a file; those it fails to remove stay, because nothing else knows of them.
MPI_FILES = {NAME + ".data.0", NAME + ".metadata.0"}


class RightFile:
    """`begun`: the bytes from which each run resumes; None if each begins anew."""

    def __init__(self, folder, job):
        self.folder = folder
        self.begun = None
        self.right = folder / "right.h5"
        (folder / "job.toml").write_text(job)
        made = launch.run("run", "job.toml", "--quiet", "--output", self.right, cwd=folder)
        assert made.returncode == 0, made.stderr

    def clear(self):
        """Called before each run."""
        for path in self.folder.glob(NAME + "*"):
            path.unlink()
        if self.begun is not None:
            (self.folder / NAME).write_bytes(self.begun)

    def problem_of_next_run(self):
        """"" if it succeeds, otherwise its message."""
        again = launch.run("run", "job.toml", "--quiet", cwd=self.folder)
        return f"the next run ends with {again.returncode}: {again.stderr[-300:]}" if again.returncode != 0 else ""

    def problem_of_file(self, code):
        """Checks a file on which some run ended with 0; `code` is that of the disturbed one."""
        try:
            map_contents.assert_same_map(self.folder / NAME, self.right)
        except (AssertionError, OSError, KeyError) as error:
            return f"another file than the right one, after code {code}: {str(error)[:200]}"
        looked_at = launch.run("run", "job.toml", "--quiet", cwd=self.folder)
        if looked_at.returncode != 0:
            return f"after code {code} the file is not complete: {looked_at.stderr[-300:]}"
        return ""

    def left_beside(self):
        """Names of files beside it that no run has removed."""
        return [path.name for path in self.folder.iterdir() if path.name.startswith(NAME + ".")]
