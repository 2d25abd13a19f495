// gem devices: lists the processors and GPUs that the program can use.
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "gem/command/command.h"
#include "gem/engine/cuda/cuda_engine.h"

namespace gem {

namespace {

nlohmann::ordered_json json_of(const CudaDevice& gpu) {
  return {{"index", gpu.index},
          {"name", gpu.name},
          {"driver", gpu.driver},
          {"memory_bytes", gpu.memory},
          {"free_memory_bytes", gpu.free_memory},
          {"multiprocessors", gpu.multiprocessors},
          {"usable", gpu.fault.empty()},
          {"fault", gpu.fault}};
}

std::string text_of(const CudaDevice& gpu) {
  const std::string name = "gpu " + std::to_string(gpu.index) + ": " + gpu.name;
  if (!gpu.fault.empty()) return name + ": cannot be used (" + gpu.fault + ")\n";
  return name + ", " + size_text(double(gpu.free_memory)) + " of " + size_text(double(gpu.memory)) + " free, " +
         gpu.driver + " (engine cuda)\n";
}

std::string devices_text(unsigned threads) {
  std::string reason, text = "cpu: " + std::to_string(threads) + " threads (engines cpu and reference)\n";
  const std::vector<CudaDevice> gpus = cuda_devices(reason);
  for (const CudaDevice& gpu : gpus) text += text_of(gpu);
  return gpus.empty() ? text + "gpu: none (" + reason + ")\n" : text;
}

std::string devices_json(unsigned threads) {
  std::string reason;
  nlohmann::ordered_json gpus = nlohmann::json::array();
  for (const CudaDevice& gpu : cuda_devices(reason)) gpus.push_back(json_of(gpu));
  const nlohmann::ordered_json object = {{"cpu_threads", threads},
                                         {"gpus", gpus},
                                         {"no_gpu_because", reason},
                                         {"engines", engine_names()},
                                         {"baselines", baseline_names()}};
  return object.dump(2) + "\n";
}

}  // namespace

void add_devices_command(CLI::App& app, Chosen& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("devices", "list the processors and GPUs that can be used");
  command->add_flag("--json", *json, "as JSON");
  command->callback([json, &chosen] {
    chosen.action = [json] {
      const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
      print(*json ? devices_json(threads) : devices_text(threads));
      return 0;
    };
  });
}

}  // namespace gem
