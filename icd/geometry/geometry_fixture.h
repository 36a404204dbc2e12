// For tests and benchmarks: draws made by hand, with a small vertex program: position = matrix * (attribute 0, 1),
// varyings = attribute 1 (+ three push constants).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "geometry/front_end.h"
#include "image/tile.h"

namespace lapilli {

struct MeshVertex {
  float x, y, z;
  float varying[3];
};

struct TestProgram {
  GraphicsPrograms programs;
  VertexBinding binding;
  ResourceTable resources;
  DrawState state;

  explicit TestProgram(uint32_t width = 1280, uint32_t height = 720, bool adds_push_constants = false) {
    Code vertex;
    vertex.stage = VK_SHADER_STAGE_VERTEX_BIT;
    vertex.attributes = {{0, 0, 0, VK_FORMAT_R32G32B32_SFLOAT},
                         {1, 0, offsetof(MeshVertex, varying), VK_FORMAT_R32G32B32_SFLOAT}};
    const Reg in = vertex.emit_n(Opcode::fetch, 3, kNoReg, kNoReg, kNoReg, 0);
    for (uint32_t row = 0; row < 4; ++row) {
      Reg sum = vertex.constant_f(row == 3 ? 1.0f : 0.0f);
      for (uint32_t column = 0; column < 3; ++column) {
        sum = vertex.emit(Opcode::fma, in + column, vertex.constant_f(row == column ? 1.0f : 0.0f), sum);
      }
      vertex.emit_void(Opcode::store_output, sum, kNoReg, kNoReg, kSlotPosition + row);
    }
    const Reg color = vertex.emit_n(Opcode::fetch, 3, kNoReg, kNoReg, kNoReg, 1);
    const Reg more = adds_push_constants ? vertex.emit_n(Opcode::load_push, 3) : kNoReg;
    for (uint32_t i = 0; i < 3; ++i) {
      const Reg sum = adds_push_constants ? vertex.emit(Opcode::fadd, color + i, more + i) : color + i;
      vertex.emit_void(Opcode::store_output, sum, kNoReg, kNoReg, kSlotVaryings + i);
    }
    vertex.emit_void(Opcode::end);
    vertex.output_slots = programs.output_slots = kSlotVaryings + 3;
    programs.vertex = std::move(assemble(std::move(vertex)).value());
    Code fragment;
    fragment.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    fragment.emit_void(Opcode::end);
    programs.fragment = std::move(assemble(std::move(fragment)).value());
    programs.varyings.assign(3, Interpolation::perspective);
    programs.writes_color = true;
    state.programs = &programs;
    state.viewport = {0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
    state.scissor = {{0, 0}, {width, height}};
  }
  TestProgram(const TestProgram&) = delete;
  TestProgram& operator=(const TestProgram&) = delete;

  void bind(const std::vector<MeshVertex>& vertices) {
    binding = {reinterpret_cast<const std::byte*>(vertices.data()), vertices.size() * sizeof(MeshVertex),
               sizeof(MeshVertex), false};
  }
  DrawCall draw(uint32_t count) const {
    DrawCall call;
    call.state = &state;
    call.bindings = &binding;
    call.resources = &resources;
    call.count = count;
    return call;
  }
  DrawCall draw_indexed(const std::vector<uint32_t>& indices) const {
    DrawCall call = draw(static_cast<uint32_t>(indices.size()));
    call.indices = {reinterpret_cast<const std::byte*>(indices.data()), indices.size() * sizeof(uint32_t),
                    VK_INDEX_TYPE_UINT32};
    return call;
  }
};

// A grid of columns x rows cells of two triangles over the whole viewport.
struct GridMesh {
  std::vector<MeshVertex> vertices;
  std::vector<uint32_t> indices;

  GridMesh(uint32_t columns, uint32_t rows) {
    for (uint32_t y = 0; y <= rows; ++y) {
      for (uint32_t x = 0; x <= columns; ++x) {
        const float u = static_cast<float>(x) / static_cast<float>(columns);
        const float v = static_cast<float>(y) / static_cast<float>(rows);
        vertices.push_back({2 * u - 1, 2 * v - 1, 0.5f, {u, v, 1}});
      }
    }
    for (uint32_t y = 0; y < rows; ++y) {
      for (uint32_t x = 0; x < columns; ++x) {
        const uint32_t at = y * (columns + 1) + x;
        const uint32_t below = at + columns + 1;
        indices.insert(indices.end(), {at, at + 1, below, below, at + 1, below + 1});
      }
    }
  }
};

inline TileGrid tiles_of(uint32_t width, uint32_t height) {
  return {(width + kTileSize - 1) / kTileSize, (height + kTileSize - 1) / kTileSize};
}

}  // namespace lapilli
