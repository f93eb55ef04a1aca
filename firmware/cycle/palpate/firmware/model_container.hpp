// A model as a container (palpate/container/layout.hpp): what the host writes and the firmware reads from its
// flash, without memory of its own and without a number that is not checked. docs/container-format.md shows
// the bytes.
//
//   NAME  optional: of the scenario, text of up to 64 bytes
//   BLCK  cubes, level          REGN  materials, densities, levels    DYNM  the step
//   RMSH  both fronts           HOLD  held regions, grasp reach       CNTC  how the tool touches
//   SCEN  the device around it
#pragma once

#include "palpate/container/chunk_table.hpp"
#include "palpate/firmware/model_checks.hpp"
#include "palpate/firmware/model_fields.hpp"

namespace palpate::firmware {

namespace model_detail {

using container::ChunkRule;
using container::Tag;

inline constexpr uint32_t kMostNameBytes = 64;
inline constexpr uint16_t kVersion = 1;

/// Places in the table.
enum Part : uint8_t { kName, kShape, kRegionTable, kDynamics, kRemesh, kHeld, kContact, kScene };
inline constexpr std::size_t kParts = 8;

constexpr ChunkRule required(Tag tag, uint32_t length, uint16_t version = kVersion) {
  return {tag, version, length, length, false};
}

inline constexpr std::array<ChunkRule, kParts> kRules = {{
    {Tag::of("NAME"), kVersion, 0, kMostNameBytes, true},
    required(model_checks::kShapeTag, 4 + kMaxCubes),
    required(model_checks::kRegionsTag, 12 * kRegions),
    required(model_checks::kDynamicsTag, 16),
    required(model_checks::kRemeshTag, 20),
    required(Tag::of("HOLD"), 12 * kHolds + 4),
    required(model_checks::kContactTag, 32),
    required(model_checks::kSceneTag, 60, 2),
}};

/// The fields of one chunk. Fields is a reader, or a writer with a const model.
template <class Fields, class ACycleModel>
void describe(Part part, Fields& fields, ACycleModel& model, uint8_t deepest) {
  switch (part) {
    case kShape:
      return model_fields::shape(fields, model.body, deepest);
    case kRegionTable:
      return model_fields::regions(fields, model.body);
    case kDynamics:
      return model_fields::dynamics(fields, model.body.dynamics);
    case kRemesh:
      return model_fields::remesh(fields, model.body.remesh);
    case kHeld:
      return model_fields::held(fields, model.body);
    case kContact:
      return model_fields::contact(fields, model.body.contact);
    case kScene:
      return model_fields::scene(fields, model.scene);
    default:
      return;
  }
}

/// A check of the whole model knows the chunk but not where it is.
inline container::Finding placed(container::Finding finding,
                                 const std::array<container::Chunk, kParts>& chunks) {
  for (const uint32_t i : bounded<kParts>(kParts, [] {})) {
    if (!finding.is_done() && chunks[i].tag == finding.tag) finding.offset = chunks[i].offset;
  }
  return finding;
}

}  // namespace model_detail

/// What its chunks say, each of which has been found by its rule (model_detail::kRules). `deepest`: the
/// profile's kMaxLevel.
[[nodiscard]] inline container::Finding read_model_chunks(
    const std::array<container::Chunk, model_detail::kParts>& chunks, uint8_t deepest, CycleModel& model) {
  using model_detail::Part;
  container::Finding finding = container::Finding::nothing();
  for (const uint32_t i : bounded<model_detail::kParts>(model_detail::kParts, [] {})) {
    if (!finding.is_done()) return finding;
    const auto part = static_cast<Part>(i);
    if (part == Part::kName) continue;
    container::FieldReader fields(chunks[i]);
    model_detail::describe(part, fields, model, deepest);
    finding = fields.finish();
  }
  return finding.is_done() ? model_detail::placed(check_model(model, deepest), chunks) : finding;
}

/// kDone with the very model that was written; or the first thing that is wrong with the file or with the
/// model, and then `model` means nothing. At boot: O(bytes), some 1 KiB of stack.
[[nodiscard]] inline container::Finding read_model(container::Bytes file, uint8_t deepest,
                                                   CycleModel& model) {
  std::array<container::Chunk, model_detail::kParts> chunks{};
  const container::Finding finding =
      container::collect(file, container::Kind::kModel, model_detail::kRules, chunks);
  return finding.is_done() ? read_model_chunks(chunks, deepest, model) : finding;
}

/// Its chunks, for a file that says more. `name`: of the scenario; what is beyond 64 bytes is left out.
template <class Sink>
void write_model_chunks(container::ChunkWriter<Sink>& writer, const CycleModel& model,
                        container::Bytes name) {
  using model_detail::Part;
  const uint32_t name_size =
      name.size < model_detail::kMostNameBytes ? name.size : model_detail::kMostNameBytes;
  for (const uint32_t i : bounded<model_detail::kParts>(model_detail::kParts, [] {})) {
    const auto part = static_cast<Part>(i);
    const container::ChunkRule& rule = model_detail::kRules[i];
    const bool is_name = part == Part::kName;
    writer.begin_chunk(rule.tag, rule.version, rule.may_be_missing ? uint16_t{0} : container::kRequiredFlag,
                       is_name ? name_size : rule.most_length);
    container::FieldWriter<Sink> fields(writer);
    if (is_name) writer.put(name.part(0, name_size));
    model_detail::describe(part, fields, model, kDeepestLevel);
    writer.end_chunk();
  }
}

template <class Sink>
[[nodiscard]] container::WriteStatus write_model(Sink& sink, const CycleModel& model, container::Bytes name) {
  container::ChunkWriter<Sink> writer(sink);
  writer.begin(container::Kind::kModel);
  write_model_chunks(writer, model, name);
  return writer.end();
}

}  // namespace palpate::firmware
