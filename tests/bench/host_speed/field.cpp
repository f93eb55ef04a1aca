#include "field.hpp"

#include "reference/static_solver.hpp"

namespace palpate::bench {
namespace {

constexpr uint32_t kTicksASlice = 10;
constexpr uint32_t kEvaluationsASlice = 20;

reference::Material material_of(const sim::ModelParameters& parameters) {
  const sim::RegionParameters& region = parameters.regions.front();
  return reference::material_of(region.youngs_modulus_pa, region.poisson_ratio, region.density_kg_m3);
}

Row row_of(const std::string& who, Work work, const std::string& integrator, const TwistedBar& bar) {
  Row row{};
  row.who = who;
  row.work = work;
  row.integrator = integrator;
  row.density_kg_m3 = bar.setup().density_kg_m3;
  row.substeps = static_cast<uint32_t>(bar.setup().substeps);
  row.tets = static_cast<uint32_t>(bar.bar().mesh().tet.size());
  row.rotations = bar.bar().rotations();
  return row;
}

double error_of(const Bar& bar, const reference::Material& material) {
  const Motion motion = bar.motion();
  return force_error(bar.mesh(), material, motion.force_position, motion.force);
}

const char* name_of(PeerMode mode) {
  switch (mode) {
    case PeerMode::kImplicit:
      return "implicit Euler, 1 Newton step";
    case PeerMode::kImplicitMultipliers:
      return "the same, ends by multipliers";
    default:
      return "explicit Euler, implicit damping";
  }
}

}  // namespace

double force_error(const reference::Mesh& mesh, const reference::Material& material,
                   const reference::Positions& at, const std::vector<reference::Vector>& force) {
  const auto exact = reference::static_forces<4>(reference::elements_of(mesh), {material}, at);
  double off = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    off += (force[i] - exact[i]).squaredNorm();
    all += exact[i].squaredNorm();
  }
  return std::sqrt(off / all);
}

Field::Entrant Field::add(Row row, std::function<void()> run, uint32_t times_a_slice,
                          std::function<void(Row&)> complete) {
  entries_.push_back({std::move(row), std::move(complete)});
  return contest_.add(std::move(run), times_a_slice);
}

Field::Entrant Field::add_ticks(const std::string& who, const Bar& bar, const Bar& full) {
  return add(
      row_of(who, Work::kTick, "symplectic Euler", *bar), [bar] { bar->tick(); }, kTicksASlice,
      [bar, full](Row& row) {
        // The forces that the next tick starts with.
        const auto next = bar->bar().copy();
        next->evaluate_forces();
        row.force_error = error_of(*next, material_of(bar->parameters()));
        row.rotations = bar->mean_rotations();
        row.distance_mm = distance_mm(bar->bar().motion().position, full->bar().motion().position);
      });
}

Field::Entrant Field::add_forces(const std::string& who, const Bar& bar) {
  const std::shared_ptr<bench::Bar> still = bar->bar().copy();
  still->evaluate_forces();
  Row row = row_of(who, Work::kForces, "", *bar);
  // Of the first evaluation, whose rotations are a step from those of the tick before.
  row.force_error = error_of(*still, material_of(bar->parameters()));
  return add(
      row, [still] { still->evaluate_forces(); }, kEvaluationsASlice, [](Row&) {});
}

Field::Entrant Field::add_peer_ticks(const std::string& who, const Bar& full, PeerMode mode) {
  const auto peer = std::make_shared<TwistedPeer>(*full, mode);
  Row row = row_of(who, Work::kTick, name_of(mode), *full);
  row.substeps = 1;
  return add(
      row, [peer] { peer->tick(); }, kTicksASlice,
      [peer, full](Row& completed) {
        peer->peer().evaluate_forces();
        const reference::Positions at = peer->peer().positions();
        completed.force_error =
            force_error(peer->mesh(), material_of(full->parameters()), at, peer->peer().forces());
        completed.distance_mm = distance_mm(at, full->bar().motion().position);
      });
}

Field::Entrant Field::add_peer_forces(const std::string& who, const Bar& full,
                                      const reference::Positions& at) {
  const auto peer = std::make_shared<TwistedPeer>(*full, PeerMode::kImplicit);
  peer->peer().set_motion(at, std::vector<reference::Vector>(at.size(), reference::Vector::Zero()));
  peer->peer().evaluate_forces();
  Row row = row_of(who, Work::kForces, "", *full);
  row.force_error = force_error(peer->mesh(), material_of(full->parameters()), at, peer->peer().forces());
  return add(
      row, [peer] { peer->peer().evaluate_forces(); }, kEvaluationsASlice, [](Row&) {});
}

void Field::race(uint32_t rounds) {
  contest_.race(rounds);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    entries_[i].row.us = contest_.time_us(i);
    entries_[i].complete(entries_[i].row);
  }
}

std::vector<Row> Field::rows() const {
  std::vector<Row> rows;
  for (const Entry& entry : entries_) rows.push_back(entry.row);
  return rows;
}

}  // namespace palpate::bench
