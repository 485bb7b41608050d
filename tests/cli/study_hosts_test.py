"""`remodel study` by MPI ranks on three hosts, also when one of them is lost. The hosts are network
namespaces of this machine, joined by a bridge in a fourth: each has its own address and name, and mpirun starts its
daemons on them through an agent that takes the place of ssh. Nothing outside these namespaces is touched."""

import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import harness
from study_test import RankTest

HOSTS = 3
# Three core seconds on a fast machine, so that the loss happens while all ranks are working.
STUDY = (
    "--pairs", "50/1,100/2", "--sigmas", "0.05,0.25", "--distances", "1", "--evaluations", 5000, "--scenarios", 2,
    "--compare-every", 20,
)  # fmt: skip
# Starts mpirun's daemon on the host with the address, as `ssh address command` would.
AGENT = """#!/bin/sh
address=$1
shift
k=$((${address##*.} - 1))
echo "$address" >>LOG
exec ip netns exec NAME$k unshare --uts sh -c 'hostname "$0" && eval "$1"' host$k "$*"
"""


def ip(*arguments):
    return subprocess.run(["ip", *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True)


class Hosts(RankTest):
    def setUp(self):
        super().setUp()
        if os.geteuid() != 0:
            self.skipTest("needs root, to make network namespaces")
        for tool, package in (("ip", "iproute2"), ("unshare", "util-linux"), ("hostname", "hostname")):
            if shutil.which(tool) is None:
                self.skipTest(f"needs {tool} ({package})")
        self.name = f"remodel-{os.getpid()}-"
        self.make_hosts()
        self.write("agent", AGENT.replace("LOG", str(self.path("agent.log"))).replace("NAME", self.name))
        self.path("agent").chmod(0o755)
        self.launcher = ("ip", "netns", "exec", self.host(0), "unshare", "--uts", "sh", "-c",
                         'hostname "$0" && exec "$@"', "host0")  # fmt: skip
        self.mpirun_options = (
            "--map-by", "node", "--mca", "plm_rsh_agent", str(self.path("agent")), "--mca", "pml", "ob1", "--mca", "btl",
            "tcp,self", "--mca", "btl_tcp_if_include", "eth0", "--mca", "oob_tcp_if_include", "eth0", "--mca",
            "orte_tmpdir_base", str(self.directory),
        )  # fmt: skip

    def make_hosts(self):
        self.make_namespace("switch")
        self.must_make("-n", self.host("switch"), "link", "add", "bridge", "type", "bridge")
        self.must_make("-n", self.host("switch"), "link", "set", "bridge", "up")
        for k in range(HOSTS):
            self.make_namespace(k)
            self.must_make("-n", self.host(k), "link", "add", "eth0", "type", "veth", "peer", "name", f"port{k}",
                           "netns", self.host("switch"))  # fmt: skip
            self.must_make("-n", self.host(k), "address", "add", f"{self.address(k)}/24", "dev", "eth0")
            self.must_make("-n", self.host(k), "link", "set", "lo", "up")
            self.must_make("-n", self.host(k), "link", "set", "eth0", "up")
            self.must_make("-n", self.host("switch"), "link", "set", f"port{k}", "master", "bridge", "up")

    def make_namespace(self, k):
        self.addCleanup(self.remove_namespace, k)
        self.must_make("netns", "add", self.host(k))

    def must_make(self, *arguments):
        made = ip(*arguments)
        if made.returncode != 0:
            self.skipTest(f"needs network namespaces: ip {' '.join(map(str, arguments))}: {made.stderr.strip()}")

    def remove_namespace(self, k):
        self.kill_all(k)
        ip("netns", "delete", self.host(k))

    def host(self, k):
        return f"{self.name}{k}"

    def address(self, k):
        return f"10.231.77.{k + 1}"

    def start_on_hosts(self, hosts, options, *arguments):
        addresses = ",".join(self.address(k) for k in range(hosts))
        process = self.start_ranks(hosts, ("--host", addresses, *options), *arguments)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        """Kills all processes of the hosts, which keep the pipes of mpirun open, and returns its output."""
        for k in range(HOSTS):
            self.kill_all(k)
        return None if process.stdout.closed else process.communicate(timeout=60)

    def pids(self, k):
        return [int(pid) for pid in ip("netns", "pids", self.host(k)).stdout.split()]

    def kill_all(self, k):
        deadline = time.monotonic() + 30
        while (pids := self.pids(k)) and time.monotonic() < deadline:
            for pid in pids:
                self.kill(pid)
            time.sleep(0.02)

    def kill(self, pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def ranks(self, k):
        """The ranks of the program on a host: their numbers and processes."""
        found = {}
        for pid in self.pids(k):
            try:
                process = Path(f"/proc/{pid}")
                if Path(os.readlink(process / "exe")) != Path(harness.PROGRAM).resolve().with_name("remodel-mpi"):
                    continue
                variables = dict(text.partition("=")[::2] for text in (process / "environ").read_text().split("\0"))
                found[int(variables["OMPI_COMM_WORLD_RANK"])] = process
            except (OSError, KeyError):
                continue
        return found

    def wait_until(self, condition, what, seconds=60):
        deadline = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            time.sleep(0.02)

    def wait_for_work(self, process):
        """Waits until all ranks have used processor time, which a waiting rank does not."""

        def at_work():
            self.assertIsNone(process.poll(), "the study ended before all ranks were at work")
            return all(k in ranks and cpu_seconds(ranks[k]) > 0.2 for k, ranks in enumerate(map(self.ranks, range(HOSTS))))

        self.wait_until(at_work, "not all ranks are at work")

    def assertWhole(self, directory):
        self.succeed(*self.study("whole", *STUDY))
        self.assertEqual(self.tables(directory), self.tables("whole"))

    def test_any_number_of_hosts(self):
        process = self.start_on_hosts(HOSTS, (), *self.study("s", *STUDY, "--json"))
        self.wait_for_work(process)
        ranks = [self.ranks(k) for k in range(HOSTS)]
        self.assertEqual([list(found) for found in ranks], [[0], [1], [2]])
        namespaces = {os.readlink(ranks[k][k] / "ns" / kind) for k in range(HOSTS) for kind in ("net", "uts")}
        self.assertEqual(len(namespaces), 2 * HOSTS, namespaces)
        stdout, message = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, message)
        self.assertEqual(json.loads(stdout)["stopped"], "done")
        self.assertEqual(sorted(self.path("agent.log").read_text().split()), [self.address(1), self.address(2)])
        self.assertWhole("s")

    def test_a_killed_rank(self):
        process = self.start_on_hosts(
            HOSTS, ("--enable-recovery",), *self.study("s", *STUDY, "--rank-timeout", 2, "--json")
        )
        self.wait_for_work(process)
        os.kill(int(self.ranks(2)[2].name), signal.SIGKILL)
        stdout, message = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, message)
        if stdout:  # which mpirun may lose on its way, where a rank was killed
            self.assertEqual(json.loads(stdout)["stopped"], "done")
        self.assertIn(b"remodel: rank 2 has been silent", message)
        self.assertWhole("s")

    def test_a_host_without_its_link(self):
        """The others finish the study, and the lost rank ends itself. mpirun itself goes on waiting for its daemon on
        the lost host, until it is interrupted twice."""
        process = self.start_on_hosts(
            HOSTS, ("--enable-recovery",), *self.study("s", *STUDY, "--rank-timeout", 2, "--json")
        )
        self.wait_for_work(process)
        self.must_make("-n", self.host("switch"), "link", "set", "port2", "down")
        self.wait_until(lambda: not any(self.ranks(k) for k in range(HOSTS)), "there are ranks left")
        self.interrupt(process)
        stdout, message = self.end(process)
        self.assertEqual(json.loads(stdout)["stopped"], "done")
        self.assertIn(b"remodel: rank 2 has been silent", message)
        figures = self.figures(*self.study("s", "--resume"))
        self.assertEqual(figures["before"], figures["jobs"])
        self.assertWhole("s")

    def test_a_host_that_dies(self):
        """All processes of a host are killed. Depending on what mpirun notices first, it ends the study, in order or
        not, or lets it go on, and then waits as above: in each case the other hosts resume it."""
        process = self.start_on_hosts(
            HOSTS, ("--enable-recovery",), *self.study("s", *STUDY, "--rank-timeout", 2, "--json")
        )
        self.wait_for_work(process)
        self.kill_all(2)
        self.wait_until(lambda: process.poll() is not None or not any(self.ranks(k) for k in (0, 1)), "ranks are left")
        self.interrupt(process)
        stdout, message = self.end(process)
        if stdout:  # which mpirun loses where it ends all ranks at once
            self.assertIn(json.loads(stdout)["stopped"], ("interrupted", "done"), message)
        process = self.start_on_hosts(2, (), *self.study("s", "--resume"))
        message = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 0, message)
        self.assertWhole("s")

    def interrupt(self, process):
        """Two interrupts within five seconds end an mpirun that waits."""
        deadline = time.monotonic() + 30
        while process.poll() is None:
            self.assertLess(time.monotonic(), deadline, "mpirun does not end")
            process.send_signal(signal.SIGINT)
            time.sleep(0.5)


def cpu_seconds(process):
    try:
        fields = (process / "stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return 0.0
