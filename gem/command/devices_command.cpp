// gem devices: what the program can compute on.
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "gem/command/command.h"

namespace gem {

void add_devices_command(CLI::App& app, Chosen& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("devices", "list what the program can compute on");
  command->add_flag("--json", *json, "as JSON");
  command->callback([json, &chosen] {
    chosen.action = [json] {
      const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
      if (*json) {
        const nlohmann::ordered_json object = {{"cpu_threads", threads},
                                               {"gpus", nlohmann::json::array()},
                                               {"gpu_engine", "not built"},
                                               {"engines", engine_names()},
                                               {"baselines", baseline_names()}};
        print(object.dump(2) + "\n");
      } else {
        print("cpu: " + std::to_string(threads) +
              " threads (engines cpu and reference)\ngpu: no GPU engine in this build\n");
      }
      return 0;
    };
  });
}

}  // namespace gem
