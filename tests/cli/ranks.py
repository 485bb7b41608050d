"""Commands under mpirun."""

import os
import shutil
import signal
import subprocess
from pathlib import Path

import harness


class UnderMpirun:
    """For tests of the program: mixed into a ProgramTest."""

    launcher = ()
    mpirun_options = ("--oversubscribe",)

    def require_ranks(self, *command):
        """Skips the test where the command cannot run under mpirun."""
        if shutil.which("mpirun") is None:
            self.skipTest("needs mpirun (openmpi-bin)")
        outcome = self.run_program(*command, env={**os.environ, "OMPI_COMM_WORLD_SIZE": "2"})
        if "built without MPI" in outcome.stderr:
            self.skipTest("the program was built without MPI")

    def start_ranks(self, ranks, options, *arguments):
        # Without these two variables mpirun refuses to run as root.
        root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        return subprocess.Popen(
            [*self.launcher, "mpirun", *self.mpirun_options, *options, "-n", str(ranks), harness.PROGRAM,
             *map(str, arguments)],
            cwd=self.directory, env={**os.environ, **root}, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )  # fmt: skip

    def kill_rank(self, process, rank):
        """Sends SIGKILL to the given rank of this mpirun, which its environment identifies."""
        for entry in Path("/proc").iterdir():
            try:
                if not entry.name.isdigit() or f"PPid:\t{process.pid}\n" not in (entry / "status").read_text():
                    continue
                if f"OMPI_COMM_WORLD_RANK={rank}".encode() in (entry / "environ").read_bytes().split(b"\0"):
                    os.kill(int(entry.name), signal.SIGKILL)
                    return
            except OSError:
                continue
        self.fail(f"no rank {rank} of {process.pid}")
