// How much loads depend on a setting: an ensemble of seeds for each variant of a case, each run on one thread, all
// processors busy. Prints one CSV row a run, then the ratios to the first variant, paired by seed: geometric mean and
// its 90 % interval.
//
// Usage: load_ensemble CASE FROM_S TO_S SEEDS JOBS [SECONDS] NAME[,KEY=VALUE...] ...
//   loads count from FROM_S to TO_S; no run starts after SECONDS (default: none). Lists in values are not supported.
#include <time.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "gem/base/error.h"
#include "gem/engine/engine.h"
#include "gem/field/field.h"
#include "gem/scene/toml/scene_file.h"

namespace gem::bench {
namespace {

struct Variant {
  std::string name;
  std::vector<std::string> settings;
};

/// Loads of one run [N], and what it took.
struct Loads {
  bool done = false;
  double mean = 0.0, sd_short = 0.0, most_short = 0.0, high_short = 0.0, most_long = 0.0, sd_long = 0.0;
  double seconds = 0.0, softened = 0.0, left = 0.0, deepest = 0.0;
  std::uint64_t hash = 0;
};

constexpr const char* load_names[] = {"mean", "sd_0.2s", "max_0.2s", "q99_0.2s", "max_1s", "sd_1s", "seconds"};
double load(const Loads& l, int k) {
  const double all[] = {l.mean, l.sd_short, l.most_short, l.high_short, l.most_long, l.sd_long, l.seconds};
  return all[k];
}

/// Reads the whole text as a number.
bool read_number(const std::string& text, double& number) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size();
}

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Means of `force` over `width` samples.
std::vector<double> blocks(const std::vector<double>& force, std::size_t width) {
  std::vector<double> means;
  for (std::size_t i = 0; i + width <= force.size(); i += width) {
    double sum = 0.0;
    for (std::size_t k = 0; k < width; ++k) sum += force[i + k];
    means.push_back(sum / static_cast<double>(width));
  }
  return means;
}

double mean_of(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double v : x) sum += v;
  return sum / static_cast<double>(x.size());
}

double deviation_of(const std::vector<double>& x) {
  const double mean = mean_of(x);
  double sum = 0.0;
  for (const double v : x) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

double quantile_of(std::vector<double> x, double share) {
  std::sort(x.begin(), x.end());
  return x[std::min(x.size() - 1, static_cast<std::size_t>(share * static_cast<double>(x.size())))];
}

Loads run(const std::string& path, const Variant& variant, int seed, double from, double to) {
  std::vector<std::string> settings = variant.settings;
  settings.push_back("run.seed=" + std::to_string(seed));
  settings.push_back("run.duration_s=" + std::to_string(to));
  const SceneDef scene = read_scene(path, settings);
  EngineOptions options;
  options.threads = 1;
  const auto engine = make_engine(scene, make_field(scene), options);
  const double dt = scene.numerics.time_step_s, start = thread_seconds();
  Loads loads;
  std::vector<double> force;
  StepLog log;
  log.wants_events = false;
  const auto steps = std::llround(to / dt);
  for (std::int64_t s = 0; s < steps; ++s) {
    log.clear();
    engine->advance(1, log);
    if (static_cast<double>(s) * dt >= from) force.push_back(log.platform.back().ice_impulse.x / dt);
    loads.deepest = std::max(loads.deepest, log.quality.back().maximum_overlap);
  }
  loads.seconds = thread_seconds() - start;
  const std::vector<double> brief = blocks(force, std::llround(0.2 / dt)),
                            whole = blocks(force, std::llround(1.0 / dt));
  loads.mean = mean_of(brief);
  loads.sd_short = deviation_of(brief);
  loads.most_short = *std::max_element(brief.begin(), brief.end());
  loads.high_short = quantile_of(brief, 0.99);
  loads.most_long = *std::max_element(whole.begin(), whole.end());
  loads.sd_long = deviation_of(whole);
  const ContactEnergy contact = engine->ledger().contact;
  loads.softened = contact.load > 0.0 ? contact.softened / contact.load : 0.0;
  loads.left = contact.crushed > 0.0 ? contact.left() / contact.crushed : 0.0;
  loads.hash = engine->state_hash();
  loads.done = true;
  return loads;
}

/// 95 % point of Student's t, for a two-sided 90 % interval; to 1 %.
double student(double freedom) { return 1.645 + 1.52 / freedom + 1.4 / (freedom * freedom); }

void print_ratios(const std::vector<Variant>& variants, const std::vector<std::vector<Loads>>& all) {
  std::printf("\nratio to %s\n%-12s", variants[0].name.c_str(), "variant");
  for (const char* name : load_names) std::printf(" %15s", name);
  std::printf("  softened  left/crushed\n");
  for (std::size_t v = 0; v < variants.size(); ++v) {
    std::printf("%-12s", variants[v].name.c_str());
    double softened = 0.0, left = 0.0;
    for (int k = 0; k < 7; ++k) {
      std::vector<double> logs;
      for (std::size_t s = 0; s < all[v].size(); ++s) {
        if (!all[v][s].done || !all[0][s].done) continue;
        logs.push_back(std::log(load(all[v][s], k) / load(all[0][s], k)));
        softened = std::max(softened, all[v][s].softened);
        left = std::max(left, std::fabs(all[v][s].left));
      }
      if (logs.size() < 2) continue;
      const auto n = static_cast<double>(logs.size());
      const double mean = std::exp(mean_of(logs));
      const double half = mean * student(n - 1.0) * deviation_of(logs) / std::sqrt(n - 1.0);
      std::printf("   %5.3f +- %5.3f", mean, half);
    }
    std::printf("  %8.4f  %8.4f\n", softened, left);
  }
}

int main_of(int count, char** text) {
  if (count < 7) {
    std::fprintf(stderr, "usage: load_ensemble CASE FROM_S TO_S SEEDS JOBS [SECONDS] NAME[,KEY=VALUE...] ...\n");
    return 2;
  }
  const std::string path = text[1];
  double from = 0.0, to = 0.0, limit = 0.0;
  if (!read_number(text[2], from) || !read_number(text[3], to)) return 2;
  const int seeds = std::atoi(text[4]), jobs = std::atoi(text[5]);
  const bool limited = read_number(text[6], limit);
  std::vector<Variant> variants;
  for (int i = limited ? 7 : 6; i < count; ++i) {
    const std::string one = text[i];
    Variant v;
    for (std::size_t at = 0, next; at <= one.size(); at = next + 1) {
      next = std::min(one.find(',', at), one.size());
      (at == 0 ? v.name : v.settings.emplace_back()) = one.substr(at, next - at);
    }
    variants.push_back(v);
  }
  using LoadsBySeed = std::vector<Loads>;
  std::vector<LoadsBySeed> all(variants.size(), LoadsBySeed(seeds));
  std::atomic<int> next{0};
  const int total = seeds * static_cast<int>(variants.size());
  const auto begin = std::chrono::steady_clock::now();
  const auto work = [&] {
    for (int job = next++; job < total; job = next++) {
      const std::size_t v = job % variants.size(), s = job / variants.size();
      if (limited && std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > limit) return;
      try {
        all[v][s] = run(path, variants[v], static_cast<int>(s) + 1, from, to);
      } catch (const Error& e) {
        std::fprintf(stderr, "%s, seed %zu: %s\n", variants[v].name.c_str(), s + 1, e.what());
      }
    }
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < jobs; ++k) threads.emplace_back(work);
  for (std::thread& t : threads) t.join();
  std::printf(
      "variant,seed,mean_N,sd_0.2s_N,max_0.2s_N,q99_0.2s_N,max_1s_N,sd_1s_N,seconds,softened,left,overlap_m,hash\n");
  for (std::size_t v = 0; v < variants.size(); ++v)
    for (int s = 0; s < seeds; ++s) {
      const Loads& l = all[v][s];
      if (!l.done) continue;
      std::printf("%s,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.2f,%.4g,%.4g,%.4g,%016llx\n", variants[v].name.c_str(), s + 1,
                  l.mean, l.sd_short, l.most_short, l.high_short, l.most_long, l.sd_long, l.seconds, l.softened, l.left,
                  l.deepest, static_cast<unsigned long long>(l.hash));
    }
  print_ratios(variants, all);
  return 0;
}

}  // namespace
}  // namespace gem::bench

int main(int count, char** text) { return gem::bench::main_of(count, text); }
