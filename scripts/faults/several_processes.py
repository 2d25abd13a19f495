"""Several processes at one file, or in one folder of a sweep."""
import os
import pathlib
import random
import signal
import subprocess
import time

from fault_runs import SMALL, SWEEP
from judge import judge, look


class SeveralProcesses:
    def two_writers(self):
        def one(_):
            path = self.path()
            command = [self.gem, "run", SMALL, "--until", "5", "--quiet", "--overwrite", "--out", path]
            runs = [subprocess.Popen(command, stderr=subprocess.PIPE, text=True) for _ in range(2)]
            ends = [(run.communicate()[1], run.returncode) for run in runs]
            for message, code in ends:
                if code not in (0, 4):
                    return f"exit {code}: {message}"
            if all(code != 0 for _, code in ends):
                return "both refused"
            return judge(self.gem, 0, "", path)

        self.each("two writers on one file", one, list(range(self.count_of(40, 4))))

    def sweeps(self):
        def hashes(folder):
            return {path.name: look(self.gem, str(path)) for path in pathlib.Path(folder).glob("*.h5")}

        command = [self.gem, "sweep", "run", SWEEP, "--quiet", "--threads", "1", "--out"]
        alone = f"{self.folder}/alone"
        subprocess.run([*command, alone], check=True, capture_output=True)
        wanted = {name: info["gem_state_hash"] for name, (info, _) in hashes(alone).items()}

        def one(n):
            folder = f"{self.folder}/sweep_{n}"
            runs = [subprocess.Popen([*command, folder], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True) for _ in
                    range(3)]
            for run in runs[:2]:
                time.sleep(random.uniform(0.0, 0.3))
                os.killpg(run.pid, signal.SIGKILL)
            for run in runs:
                run.wait()
            done = subprocess.run([*command, folder], capture_output=True, text=True)
            if done.returncode != 0:
                return f"exit {done.returncode}: {done.stderr[-200:]}"
            for name, (info, fault) in hashes(folder).items():
                if fault:
                    return f"{name}: {fault}"
                if wanted[name] != info["gem_state_hash"]:
                    return f"{name}: another hash"
            return None if len(hashes(folder)) == len(wanted) else "runs are missing"

        self.report("sweep by three processes, two killed", [(n, one(n)) for n in range(self.count_of(20, 2))])
