// The bytes of a checkpoint: a mark, the version, then its parts. Each part has a length and a checksum.
#include "gem/run/checkpoint/checkpoint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "gem/base/byte_stream.h"
#include "gem/run/checkpoint/check_state.h"

namespace gem {
namespace {

constexpr std::array<char, 8> mark = {'g', 'e', 'm', 'c', 'h', 'e', 'c', 'k'};

/// Raised with every change of a type below: a checkpoint of another version cannot be read.
constexpr std::uint64_t version = 7;

/// What stands before the bytes of a part: a ByteReader takes it for a number and the head of a list of bytes.
struct PartHead {
  std::uint64_t sum = 0;
  std::uint64_t element_size = 1;
  std::uint64_t length = 0;
};

/// FNV-1a over words of 8 bytes instead of bytes, five times as fast. The rotation lets the highest bit of a word reach
/// the others, else two changed words could cancel.
std::uint64_t checksum(const std::byte* bytes, std::size_t size) {
  std::uint64_t value = 0xcbf29ce484222325U;
  const auto add = [&value](std::uint64_t word) { value = std::rotl(value ^ word, 29) * 0x100000001b3U; };
  std::uint64_t word = 0;
  for (; size >= sizeof word; bytes += sizeof word, size -= sizeof word) {
    std::memcpy(&word, bytes, sizeof word);
    add(word);
  }
  word = size;
  std::memcpy(&word, bytes, std::min(size, sizeof word - 1));
  add(word);
  return value;
}

template <class Stream, class State>
void pass_bodies(Stream& s, State& b) {
  s(b.kind, b.ice_class, b.vertex_begin, b.vertex, b.radius, b.area, b.thickness, b.mass, b.inertia, b.inverse_mass,
    b.inverse_inertia, b.drag, b.spin_drag);
  s(b.position, b.rotation, b.velocity, b.spin, b.active);
}

template <class Stream, class State>
void pass_engine(Stream& s, State& e) {
  s(e.step, e.ledger, e.books, e.impulse_key, e.impulse_value, e.broken, e.dp, e.loads.before, e.loads.now,
    e.loads.crack_energy, e.loads.full);
  s(e.corner_key, e.corner_value, e.substeps);
  pass_bodies(s, e.bodies);
}

template <class Stream, class Floe>
void pass_floe(Stream& s, Floe& f) {
  s(f.outline_m, f.position_m, f.angle_rad, f.velocity_m_per_s, f.spin_rad_per_s, f.thickness_m);
}

template <class Stream>
void pass_floes(Stream& s, const std::vector<FloeDef>& floes) {
  s(std::uint64_t{floes.size()});
  for (const FloeDef& floe : floes) pass_floe(s, floe);
}

void pass_floes(ByteReader& s, std::vector<FloeDef>& floes) {
  std::uint64_t count = 0;
  s(count);
  for (std::uint64_t k = 0; k < count; ++k) pass_floe(s, floes.emplace_back());
}

template <class Stream, class Position>
void pass_position(Stream& s, Position& p) {
  s(p.platform, p.events, p.stats, p.frames, p.contacts, p.splits, p.last_time);
  auto& w = p.waiting;
  s(w.platform, w.events, w.stats, w.contacts, w.splits, w.side_normal, w.side_friction, w.line_tension,
    w.line_break_time, w.time);
  s(w.thruster_x, w.thruster_y, w.thruster_limit, w.dp_demand_surge, w.dp_demand_sway, w.dp_demand_yaw,
    w.dp_offset_surge, w.dp_offset_sway, w.dp_offset_yaw);
  s(w.floes.time, w.floes.x, w.floes.y, w.floes.theta, w.floes.vx, w.floes.vy, w.floes.omega, w.floes.active);
}

/// Hands the parts of a checkpoint to `part`, each as a function of a stream.
template <class State, class Part>
void pass_parts(State& c, Part part) {
  part([&](auto& s) { s(c.serial, c.build, c.case_sha256, c.engine_name); });
  part([&](auto& s) { pass_engine(s, c.engine); });
  part([&](auto& s) { pass_floes(s, c.floes); });
  part([&](auto& s) {
    s(c.recorder.now, c.recorder.window, c.recorder.hits, c.watch, c.totals);
    s(c.recorder.sides.normal, c.recorder.sides.friction, c.recorder.lines.tension, c.recorder.lines.break_time);
    s(c.recorder.thrusters);
  });
  part([&](auto& s) { pass_position(s, c.position); });
}

}  // namespace

std::vector<std::byte> checkpoint_bytes(const Checkpoint& checkpoint) {
  ByteCount size;
  size(mark, version);
  pass_parts(checkpoint, [&size](auto pass) {
    size(PartHead{});
    pass(size);
  });
  // memory of the right size, and no copies: most of the time of a checkpoint goes into memory that is touched first
  ByteWriter file;
  file.reserve(size.size());
  file(mark, version);
  pass_parts(checkpoint, [&file](auto pass) {
    const std::size_t head = file.size();
    file(PartHead{});
    const std::size_t begin = file.size();
    pass(file);
    const std::size_t length = file.size() - begin;
    file.replace(head + offsetof(PartHead, sum), checksum(file.data() + begin, length));
    file.replace(head + offsetof(PartHead, length), length);
  });
  return file.take();
}

Checkpoint checkpoint_of(const std::vector<std::byte>& bytes) {
  ByteReader file(bytes.data(), bytes.size());
  std::array<char, 8> found{};
  std::uint64_t of_version = 0;
  file(found, of_version);
  if (found != mark) throw ByteFault("it is no checkpoint");
  if (of_version != version) throw ByteFault("its version is " + std::to_string(of_version));
  Checkpoint checkpoint;
  pass_parts(checkpoint, [&file](auto pass) {
    std::uint64_t sum = 0;
    std::vector<std::byte> part;
    file(sum, part);
    if (sum != checksum(part.data(), part.size())) throw ByteFault("a checksum is wrong");
    ByteReader stream(part.data(), part.size());
    pass(stream);
    if (stream.left() > 0) throw ByteFault("a part is too long");
  });
  if (file.left() > 0) throw ByteFault("it is too long");
  const std::string fault = fault_of(checkpoint);
  if (!fault.empty()) throw ByteFault(fault);
  return checkpoint;
}

}  // namespace gem
