// LAPILLI_STATS=1 on scenes whose counts follow from their geometry.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "queue/test_scene.h"

namespace lapilli {
namespace {

class Ledger : public testing::Test {
 protected:
  Ledger() {
    setenv("LAPILLI_STATS", "1", 1);
    scene.emplace(128, 64, std::vector<std::array<float, 4>>{{1, 0, 0, 1}, {0, 1, 0, 1}});
    unsetenv("LAPILLI_STATS");
  }
  // Draws what `record` records and returns what is printed.
  template <class Record>
  std::string draw(const Pipeline& pipeline, const Record& record) {
    CommandBuffer& commands = scene->add_commands();
    scene->begin_pass(commands);
    record_bind_pipeline(commands, pipeline);
    record(commands);
    record_end_render_pass(commands);
    testing::internal::CaptureStderr();
    scene->submit(commands);
    return testing::internal::GetCapturedStderr();
  }
  // The count of a removal in the section that begins with `section`; 0 where there is no such line.
  static uint64_t count(const std::string& text, const std::string& section, const std::string& removal) {
    std::istringstream lines(text);
    bool inside = false;
    uint64_t result = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("    ", 0) != 0) inside = line.rfind("  " + section + ":", 0) == 0;
      if (!inside || line.rfind("    " + removal + " ", 0) != 0) continue;
      result = std::stoull(line.substr(removal.size() + 4));
    }
    return result;
  }

  std::optional<TestScene> scene;
};

// Depth falls: each layer hides the one before. All but the last are hidden, at every pixel.
TEST_F(Ledger, PixelsOfHiddenLayers) {
  const std::string text = draw(scene->add_pipeline(), [&](CommandBuffer& commands) {
    for (int layer = 0; layer < 12; ++layer) {
      scene->draw(commands, -1, -1, 1, 1, 0.9f - 0.05f * static_cast<float>(layer), static_cast<uint32_t>(layer % 2));
    }
  });
  EXPECT_EQ(count(text, "draw 0", "hidden"), 128u * 64) << text;
  EXPECT_EQ(count(text, "draws 8 to 11", "hidden"), 3u * 128 * 64) << text;
  EXPECT_EQ(count(text, "all 12 draws", "hidden"), 11u * 128 * 64) << text;
  EXPECT_EQ(scene->pixel(100, 50)[1], 255);
}

// Depth rises: all but the first fail the early test.
TEST_F(Ledger, PixelsBehindTheFirstLayer) {
  const std::string text = draw(scene->add_pipeline(), [&](CommandBuffer& commands) {
    for (int layer = 0; layer < 4; ++layer) {
      scene->draw(commands, -1, -1, 1, 1, 0.1f + 0.05f * static_cast<float>(layer), static_cast<uint32_t>(layer % 2));
    }
  });
  EXPECT_EQ(count(text, "draw 0", "hidden"), 0u) << text;
  EXPECT_EQ(count(text, "draw 3", "hidden"), 128u * 64) << text;
  EXPECT_EQ(count(text, "all 4 draws", "hidden"), 3u * 128 * 64) << text;
}

TEST_F(Ledger, TrianglesThatAreCulledOrOutside) {
  const std::string text = draw(scene->add_pipeline(VK_CULL_MODE_BACK_BIT), [&](CommandBuffer& commands) {
    scene->draw(commands, -1, -1, 1, 1, 0.5f, 0);                // two front or two back faces
    scene->draw(commands, 1, -1, -1, 1, 0.5f, 0);                // mirrored: the other way round
    scene->draw(commands, 2, 2, 3, 3, 0.5f, 0);                  // outside
    scene->draw(commands, -1, -1, -0.9999f, -0.9999f, 0.5f, 0);  // between pixel centres
  });
  EXPECT_EQ(count(text, "draw 0", "triangles") + count(text, "draw 1", "triangles"), 2u) << text;
  EXPECT_EQ(count(text, "draw 2", "triangles"), 2u) << text;
  EXPECT_EQ(count(text, "draw 3", "triangles"), 2u) << text;
}

// Six indices name four vertices.
TEST_F(Ledger, VerticesThatTrianglesShare) {
  const uint16_t indices[] = {0, 1, 2, 2, 1, 5};
  auto buffer = make_object<Buffer>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  buffer->data = const_cast<std::byte*>(reinterpret_cast<const std::byte*>(indices));
  buffer->size = sizeof(indices);
  const std::string text = draw(scene->add_pipeline(), [&](CommandBuffer& commands) {
    record_bind_index_buffer(commands, buffer.get(), 0, VK_INDEX_TYPE_UINT16);
    scene->draw(commands, -1, -1, 1, 1, 0.5f, 0);  // without indices: nothing shared
    scene->place(commands, -1, -1, 1, 1, 0.4f, 0);
    record_draw_indexed(commands, {6, 1, 0, 0, 0});
  });
  EXPECT_EQ(count(text, "draw 0", "vertices"), 0u) << text;
  EXPECT_EQ(count(text, "draw 1", "vertices"), 2u) << text;
  EXPECT_NE(text.find("  draw 1: 4 vertices, "), std::string::npos) << text;
}

// The vertex shader writes four components that the fragment shader does not have: not computed for any of six
// vertices.
TEST_F(Ledger, VaryingsThatNobodyReads) {
  const std::string text = draw(scene->add_pipeline(), [&](CommandBuffer& commands) {
    scene->draw(commands, -1, -1, 1, 1, 0.5f, 0);
    scene->draw(commands, -1, -1, 1, 1, 0.4f, 0);
  });
  EXPECT_EQ(count(text, "draw 0", "varyings"), 4u * 6) << text;
  EXPECT_EQ(count(text, "all 2 draws", "varyings"), 2u * 4 * 6) << text;
}

// Four loads: the rectangle's place and its size, the depth, the colour. The fragment shader has nothing of the kind.
TEST_F(Ledger, OpsThatRunOncePerDraw) {
  const std::string text = draw(scene->add_pipeline(), [&](CommandBuffer& commands) {
    scene->draw(commands, -1, -1, 1, 1, 0.5f, 0);
    scene->draw(commands, -1, -1, 1, 1, 0.4f, 1);
  });
  EXPECT_EQ(count(text, "draw 0", "uniforms"), 4u) << text;
  EXPECT_EQ(count(text, "all 2 draws", "uniforms"), 8u) << text;
}

// A multiplication makes the alpha that the mask leaves out.
TEST_F(Ledger, OutputsThatAreMasked) {
  const auto record = [&](CommandBuffer& commands) { scene->draw(commands, -1, -1, 1, 1, 0.5f, 0); };
  EXPECT_EQ(count(draw(scene->add_pipeline(), record), "draw 0", "outputs"), 0u);
  const std::string text = draw(scene->add_pipeline(VK_CULL_MODE_NONE, 0x7), record);
  const size_t fragments = text.find("vertices, ") + 10;
  ASSERT_LT(fragments, text.size()) << text;
  EXPECT_EQ(count(text, "draw 0", "outputs"), std::stoull(text.substr(fragments))) << text;
  EXPECT_GE(count(text, "draw 0", "outputs"), 128u * 64) << text;
}

// Both triangles of the rectangle are shaded in one batch of the 8x8 block that they cover, each pixel once: the
// program looks at no neighbours, so that the quads along the diagonal need no helpers.
TEST_F(Ledger, PixelsOfABlockAreShadedTogether) {
  const std::string text = draw(scene->add_pipeline(), [&](CommandBuffer& commands) {
    scene->draw(commands, -1, -1, -1 + 2 * 8 / 128.0f, -1 + 2 * 8 / 64.0f, 0.5f, 0);
  });
  EXPECT_NE(text.find("  draw 0: 6 vertices, 64 fragments, "), std::string::npos) << text;
}

TEST_F(Ledger, NothingIsPrintedWhereNothingIsDrawn) {
  EXPECT_EQ(draw(scene->add_pipeline(), [](CommandBuffer&) {}), "");
}

}  // namespace
}  // namespace lapilli
