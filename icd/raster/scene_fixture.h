// For tests and benchmarks: passes with hand-built programs, whose fragment plans can be chosen freely.
#pragma once

#include <cstdlib>
#include <vector>

#include "raster/render_pass.h"
#include "shader/ir.h"

namespace lapilli {

// A vertex of the test programs: position and colour, 8 floats.
struct Vertex {
  float position[4];
  float color[4];
};

inline ProgramPtr build(Code code) {
  Result<ProgramPtr> program = assemble(std::move(code));
  if (!program) std::abort();
  return std::move(*program);
}

inline ProgramPtr vertex_program() {
  Code code;
  code.stage = VK_SHADER_STAGE_VERTEX_BIT;
  code.attributes = {{0, 0, 0, VK_FORMAT_R32G32B32A32_SFLOAT}, {1, 0, 16, VK_FORMAT_R32G32B32A32_SFLOAT}};
  const Reg position = code.emit_n(Opcode::fetch, 4, kNoReg, kNoReg, kNoReg, 0);
  const Reg color = code.emit_n(Opcode::fetch, 4, kNoReg, kNoReg, kNoReg, 1);
  for (uint32_t i = 0; i < 4; ++i) {
    code.emit_void(Opcode::store_output, position + i, kNoReg, kNoReg, kSlotPosition + i);
    code.emit_void(Opcode::store_output, color + i, kNoReg, kNoReg, kSlotVaryings + i);
  }
  code.output_slots = kSlotVaryings + 4;
  code.emit_void(Opcode::end);
  return build(std::move(code));
}

// Writes the interpolated colour, or with `accumulate` adds it to what is there. A late depth test is in the program.
inline ProgramPtr fragment_program(const FragmentPlan& plan, bool accumulate,
                                   VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT) {
  Code code;
  code.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  code.color_formats = {format};
  const uint32_t done = code.new_label();
  if (plan.depth_test && !plan.early_depth) {
    const Reg z = code.emit(Opcode::frag_depth);
    code.emit_void(Opcode::depth_test, z, kNoReg, kNoReg,
                   static_cast<uint32_t>(plan.depth_compare) | (plan.depth_write ? 8u : 0u), done);
  }
  code.emit_void(Opcode::count_samples);
  if (plan.writes_color) {
    const Reg color = code.emit_n(Opcode::interpolate_perspective, 4);
    Reg out[4];
    const Reg old = accumulate ? code.emit_n(Opcode::load_color, 4) : kNoReg;
    for (uint32_t i = 0; i < 4; ++i) out[i] = accumulate ? code.emit(Opcode::fadd, old + i, color + i) : color + i;
    Instruction& store = code.append(Opcode::store_color);
    store.imm2 = 0xF;
    code.set_list(store, out);
  }
  code.place_label(done);
  code.emit_void(Opcode::end);
  return build(std::move(code));
}

inline void add_rectangle(std::vector<Vertex>& out, float x0, float y0, float x1, float y1, float z, float value) {
  const Vertex corners[4] = {{{x0, y0, z, 1}, {value, value, value, value}},
                             {{x1, y0, z, 1}, {value, value, value, value}},
                             {{x0, y1, z, 1}, {value, value, value, value}},
                             {{x1, y1, z, 1}, {value, value, value, value}}};
  for (const int i : {0, 1, 2, 2, 1, 3}) out.push_back(corners[i]);
}

inline bool same_plan(const FragmentPlan& a, const FragmentPlan& b) {
  return a.depth_test == b.depth_test && a.early_depth == b.early_depth && a.depth_write == b.depth_write &&
         a.depth_compare == b.depth_compare && a.writes_color == b.writes_color && a.deferrable == b.deferrable &&
         a.pixels_alone == b.pixels_alone;
}

// A pass over one float colour target and one of depth, with draws of any plan.
struct ScenePass {
  struct Draw {
    FragmentPlan plan;
    bool accumulate = false;
    std::vector<Vertex> vertices;
    GraphicsPrograms programs = {};
    DrawState state = {};
    VertexBinding binding[kMaxVertexBindings] = {};
    uint64_t samples = 0;
    DrawLedger ledger = {};
  };

  ThreadPool pool;
  Renderer renderer;
  uint32_t width, height;
  std::vector<float> color, depth;
  AttachmentTarget color_target, depth_target;
  VkRect2D area;
  std::vector<Draw> draws;

  ScenePass(uint32_t w, uint32_t h, unsigned threads)
      : pool(threads), renderer(pool), width(w), height(h), color(size_t{w} * h * 4, 0.0f), depth(size_t{w} * h, 1.0f) {
    color_target.data = reinterpret_cast<std::byte*>(color.data());
    color_target.format = find_format(VK_FORMAT_R32G32B32A32_SFLOAT);
    color_target.row_pitch = uint64_t{w} * 16;
    depth_target.data = reinterpret_cast<std::byte*>(depth.data());
    depth_target.format = find_format(VK_FORMAT_D32_SFLOAT);
    depth_target.row_pitch = uint64_t{w} * 4;
    area = {{0, 0}, {w, h}};
  }

  // Makes the programs. `in_order`: everything is left to the fragment programs, depth test included.
  void build_draws(bool in_order, VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT) {
    const Draw* before = nullptr;
    for (Draw& draw : draws) {
      if (before != nullptr && before->accumulate == draw.accumulate && same_plan(before->plan, draw.plan)) {
        draw.state = before->state;
        continue;
      }
      before = &draw;
      GraphicsPrograms& programs = draw.programs;
      static_cast<FragmentPlan&>(programs) = draw.plan;
      if (in_order) programs.early_depth = programs.deferrable = programs.pixels_alone = false;
      programs.fragment_reads_nothing = !in_order && !programs.writes_color;
      programs.vertex = vertex_program();
      programs.fragment = fragment_program(programs, draw.accumulate, format);
      programs.varyings.assign(4, Interpolation::perspective);
      programs.output_slots = kSlotVaryings + 4;
      draw.state.programs = &programs;
      draw.state.viewport = {0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
      draw.state.scissor = {{0, 0}, {width, height}};
    }
  }

  VkResult run(bool with_ledger = false, bool with_query = true) {
    const ResourceTable resources;
    std::vector<DrawCall> calls;
    for (Draw& draw : draws) {
      draw.binding[0] = {reinterpret_cast<const std::byte*>(draw.vertices.data()),
                         draw.vertices.size() * sizeof(Vertex), sizeof(Vertex), false};
      DrawCall& call = calls.emplace_back();
      call.state = &draw.state;
      call.bindings = draw.binding;
      call.resources = &resources;
      call.count = static_cast<uint32_t>(draw.vertices.size());
      if (with_query) call.samples_passed = &draw.samples;
      if (with_ledger) call.ledger = &draw.ledger;
    }
    PassTarget target;
    target.width = width;
    target.height = height;
    target.render_area = area;
    target.color = std::span(&color_target, 1);
    target.depth = depth_target;
    ExecutionLimits limits;
    return renderer.render(target, calls, limits);
  }
};

}  // namespace lapilli
