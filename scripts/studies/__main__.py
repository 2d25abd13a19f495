"""Tables, figures and pages of the studies, made from what programs measured.

usage: python3 scripts/studies COMMAND [ARGUMENT...]      (COMMAND --help says what it takes)
"""
import importlib
import sys

# Command: its module, what it does.
COMMANDS = {
    "verification": ("verification_table", "runs the closed-form cases; writes the tables of validation/README.md"),
    "hard": ("hard_table", "runs the hard cases; writes the table of validation/hard/README.md"),
    "closed_form": ("closed_form_table", "runs the closed-form cases with gem and Box2D; writes validation/baseline"),
    "speed_against_error": ("speed_against_error", "measures, or takes a measurement; writes validation/baseline"),
    "take": ("take_all", "takes what scripts/measure_all.sh made elsewhere; makes its pages again"),
    "time_step_windows": ("time_step_windows", "runs the windows of the time step study; writes bench/results/time_step"),
    "time_step_study": ("time_step_study", "writes validation/time_step_study.md from bench/results/time_step"),
    "real_time_factor": ("real_time_factor", "measures the speed of whole runs; writes one CSV"),
    "scene_bench": ("scene_bench", "measures features and growth with gem_bench; writes one CSV"),
    "phase_times": ("phase_times", "reads Nsight Compute's output; prints the time of each phase on a GPU as CSV"),
    "guide_numbers": ("guide_numbers", "runs the example of the user guide; writes its numbers into the page"),
    "scatter": ("scatter_page", "reads the folder of cases/scatter.toml; writes validation/paper/scatter.md"),
    "scatter36": ("scatter36_page", "reads what scripts/scatter_gpu.sh made; writes validation/paper/scatter36.md"),
    "converged": ("converged_page", "judges the runs of bench/results/paper_splitting; writes validation/paper/converged.md"),
    "breakup": ("breakup_table", "reads the folder of cases/splitting_thickness.toml; prints the table of its page"),
    "resistance": ("resistance_page", "reads the folder of cases/pack_ice_resistance.toml; writes validation/resistance.md"),
    "loads": ("loads_page", "writes table and figure of gem/manual/how_sure.md from bench/results"),
    "readme_tables": ("readme_tables", "writes the tables of README.md from bench/results"),
}


def usage():
    return __doc__ + "\n" + "\n".join(f"  {name:<20} {what}" for name, (_, what) in COMMANDS.items())


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else "--help"
    if name in ("-h", "--help"):
        print(usage())
    elif name not in COMMANDS:
        sys.exit(f"no command '{name}'\n{usage()}")
    else:
        sys.argv[:2] = [f"studies {name}"]
        importlib.import_module(COMMANDS[name][0]).main()


if __name__ == "__main__":
    main()
