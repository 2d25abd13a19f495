"""When a run has survived a fault: what its file and its exit code must say."""
import json
import os
import subprocess

try:
    import h5py
except ImportError:
    h5py = None


def rows_fault(path):
    """What is wrong with the rows, read without gem, or None."""
    with h5py.File(path, "r", swmr=True) as file:
        for group in ("floes", "platform", "stats"):
            times = file[group]["time"][...]
            if (times[1:] <= times[:-1]).any():
                return f"{group}/time does not increase"
        frames = min(len(file["floes/time"]), len(file["floes/vx"]), len(file["floes/active"]))
        if len(file["shape/vertex_count"]) and frames and not file["floes/active"][:frames].any(axis=1).all():
            return "a frame of zeros"
        steps = file["stats/steps"][...]
        if (steps[1:] <= steps[:-1]).any():
            return "stats/steps does not increase"
    return None


def look(gem, path):
    """(description of the file or None, fault or None)"""
    if not os.path.exists(path):
        return None, None
    done = subprocess.run([gem, "info", path, "--json"], capture_output=True, text=True, timeout=60)
    if done.returncode != 0:
        return None, f"gem info: {done.stderr.strip()[:200]}"
    info = json.loads(done.stdout)
    try:
        fault = rows_fault(path)
    except (OSError, KeyError, RuntimeError) as error:
        fault = f"h5py: {error}"
    if fault is None and info["frames"] == 0:
        fault = "no frame"
    return info, fault


ENDED = ("complete", "stopped:until")  # as asked


def judge(gem, code, message, path):
    """None, or why the run is lost."""
    info, fault = look(gem, path)
    if fault:
        return fault
    if code == 0:
        return None if info and info["gem_status"] in ENDED else f"exit 0 but {info and info['gem_status']}"
    if code not in (4, 7):
        return f"exit {code} {message.strip()[-200:]}"
    if "gem: " not in message and "error" not in message:
        return f"exit {code} without a message"
    if info and info["gem_status"] in ENDED:
        return "exit %d but complete" % code
    return None
