// The four shader…ArrayDynamicIndexing features: descriptors of each type out of arrays, by an index that is known when
// the shader runs, in three stages. Indices outside read zero or another descriptor's data and write nothing anywhere
// else. Specification: "Features", "Descriptor Set Layout", "Robust Buffer Access".
#include <gtest/gtest.h>

#include "common/pipeline.h"
#include "features/drawing_fixture.h"
#include "harness/compute.h"
#include "harness/descriptors.h"
#include "harness/texture.h"
#include "shaders/array_indexing.comp.h"
#include "shaders/array_indexing.frag.h"
#include "shaders/array_indexing.vert.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kResults = 8, kDeclared = 3;  // as in array_indexing_body.glsl
constexpr uint32_t kInvocations = 192;           // whole workgroups and whole triangles
constexpr VkDeviceSize kStart = 256;             // of the data in each buffer
constexpr uint32_t kUntouched = 0xA5A5A5A5;

// What has the number k in the arrays of the set.
struct Element {
  samples::Image combined, picture, image;
  samples::Sampler sampler;
  samples::Buffer uniform, storage;

  explicit Element(uint32_t k)
      : combined(texels(100 + k, {4, 5 + k}, VK_IMAGE_USAGE_SAMPLED_BIT)),
        picture(texels(200 + k, {4, 4}, VK_IMAGE_USAGE_SAMPLED_BIT)),
        image(texels(300 + k, {4 + k, 1}, VK_IMAGE_USAGE_STORAGE_BIT)),
        // Beyond the edge: the same image again, or an opaque white border, which is 1.
        sampler(make_sampler(subject(), {.u = repeats(k) ? VK_SAMPLER_ADDRESS_MODE_REPEAT : kBorder,
                                         .border = VK_BORDER_COLOR_INT_OPAQUE_WHITE})),
        uniform(buffer({0, 400 + k, 0, 0}, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)),
        storage(buffer(storage_words(k), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)) {}

  static constexpr VkSamplerAddressMode kBorder = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
  static bool repeats(uint32_t k) { return k % 2 == 0; }
  static uint32_t words(uint32_t k) { return 8 + k; }  // of the runtime array

  static samples::Image texels(uint32_t value, VkExtent2D extent, VkImageUsageFlags usage) {
    const std::vector<uint32_t> all(size_t{extent.width} * extent.height, value);
    const auto bytes = std::as_bytes(std::span(all));
    return usage == VK_IMAGE_USAGE_STORAGE_BIT ? storage_image(subject(), extent, VK_FORMAT_R32_UINT, bytes)
                                               : upload(subject(), extent, VK_FORMAT_R32_UINT, bytes);
  }
  static std::vector<uint32_t> storage_words(uint32_t k) {
    std::vector<uint32_t> all(2 + words(k), 0);
    all[1] = 500 + k;
    return all;
  }
  // Between words that nobody may touch.
  static samples::Buffer buffer(const std::vector<uint32_t>& data, VkBufferUsageFlags usage) {
    std::vector<uint32_t> all(kStart / 4, kUntouched);
    all.insert(all.end(), data.begin(), data.end());
    all.resize(all.size() + 64, kUntouched);
    return {subject(), std::span<const uint32_t>(all), usage};
  }
};

struct Arrays {
  uint32_t count;          // of elements in the set's arrays
  bool dynamic = false;    // buffers with dynamic offsets
  uint32_t missing = ~0u;  // an element that is not written
};

class Set {
 public:
  Set(const Arrays& arrays, const std::vector<Element>& elements, const samples::Buffer& in, const samples::Buffer& out)
      : arrays_(arrays), descriptors_(subject(), slots(arrays, elements, in, out)) {}

  VkDescriptorSetLayout layout() const { return descriptors_.layout(); }
  void bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipelineLayout layout) const {
    const std::vector<uint32_t> offsets(arrays_.dynamic ? 2 * arrays_.count : 0, uint32_t(kStart));
    const VkDescriptorSet set = descriptors_.get();
    vkCmdBindDescriptorSets(commands, point, layout, 0, 1, &set, uint32_t(offsets.size()), offsets.data());
  }

 private:
  static DescriptorSlot image(uint32_t k, uint32_t binding, VkDescriptorType type, VkSampler sampler, VkImageView view,
                              VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
    DescriptorSlot slot = {binding, type};
    slot.image = {sampler, view, layout};
    slot.element = k;
    return slot;
  }
  static DescriptorSlot buffer(uint32_t k, uint32_t binding, VkDescriptorType type, const samples::Buffer& of,
                               VkDeviceSize offset, VkDeviceSize range) {
    DescriptorSlot slot = {binding, type};
    slot.buffer = {of.get(), offset, range};
    slot.element = k;
    return slot;
  }
  static std::vector<DescriptorSlot> slots(const Arrays& arrays, const std::vector<Element>& elements,
                                           const samples::Buffer& in, const samples::Buffer& out) {
    const VkDescriptorType uniform =
        arrays.dynamic ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    const VkDescriptorType storage =
        arrays.dynamic ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const VkDeviceSize start = arrays.dynamic ? 0 : kStart;
    std::vector<DescriptorSlot> all;
    for (uint32_t binding = 0; binding < 6; ++binding) {
      for (uint32_t k = 0; k < arrays.count; ++k) {
        const Element& e = elements[k];
        const DescriptorSlot each[] = {
            image(k, 0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, e.sampler.get(), e.combined.view()),
            image(k, 1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_NULL_HANDLE, e.picture.view()),
            image(k, 2, VK_DESCRIPTOR_TYPE_SAMPLER, e.sampler.get(), VK_NULL_HANDLE),
            image(k, 3, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_NULL_HANDLE, e.image.view(), VK_IMAGE_LAYOUT_GENERAL),
            buffer(k, 4, uniform, e.uniform, start, 16),
            buffer(k, 5, storage, e.storage, start, 4 * (2 + Element::words(k)))};
        all.push_back(each[binding]);
        all.back().written = k != arrays.missing;
      }
    }
    all.push_back(buffer(0, 6, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, in, 0, VK_WHOLE_SIZE));
    all.push_back(buffer(0, 7, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, out, 0, VK_WHOLE_SIZE));
    return all;
  }

  Arrays arrays_;
  Descriptors descriptors_;
};

void dispatch(const Set& set) {
  const VkDescriptorSetLayout set_layout = set.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const samples::Pipeline pipeline =
      samples::create_compute_pipeline(subject(), shaders::kArrayIndexingComp, layout.get());
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
  set.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout.get());
  vkCmdDispatch(commands, kInvocations / 64, 1, 1);
  subject().submit_and_wait(commands);
}

// One invocation for each of the first vertices, or for each pixel of a row.
void draw(const Set& set, VkShaderStageFlagBits stage) {
  const bool vertices = stage == VK_SHADER_STAGE_VERTEX_BIT;
  const Canvas canvas(subject(), {.width = kInvocations, .height = 1});
  const VkDescriptorSetLayout set_layout = set.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  PipelineState state;
  state.vertex_shader = vertices ? std::span<const uint32_t>(shaders::kArrayIndexingVert)
                                 : std::span<const uint32_t>(shaders::kPositionColorVert);
  state.fragment_shader = vertices ? std::span<const uint32_t>(shaders::kFlatColorFrag)
                                   : std::span<const uint32_t>(shaders::kArrayIndexingFrag);
  state.rasterizer_discard = vertices;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  std::vector<ColoredVertex> corners;
  add_rectangle(corners, canvas, {{0, 0}, {kInvocations, 1}}, 0.5f, {1, 1, 1, 1});
  corners.resize(kInvocations);
  const samples::Buffer buffer(subject(), std::span<const ColoredVertex>(corners), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {});
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  set.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get());
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdDraw(commands, vertices ? kInvocations : 6, 1, 0, 0);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
}

std::vector<uint32_t> words_of(const samples::Buffer& buffer) {
  std::vector<uint32_t> words(buffer.size() / 4);
  std::memcpy(words.data(), buffer.data(), buffer.size());
  return words;
}

// Runs the stage with these indices, one for each invocation.
void expect_arrays(const Arrays& arrays, VkShaderStageFlagBits stage, const std::vector<uint32_t>& indices) {
  std::vector<Element> elements;
  for (uint32_t k = 0; k < arrays.count; ++k) elements.emplace_back(k);
  const samples::Buffer in(subject(), std::span<const uint32_t>(indices), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const samples::Buffer out(subject(), kInvocations * kResults * 4, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Set set(arrays, elements, in, out);
  stage == VK_SHADER_STAGE_COMPUTE_BIT ? dispatch(set) : draw(set, stage);

  const std::vector<uint32_t> results = words_of(out);
  std::vector<uint32_t> users(arrays.count, 0);
  const auto exists = [&](uint32_t k) { return k < arrays.count && k != arrays.missing; };
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const uint32_t k = indices[n], mirrored = kDeclared - 1 - k;
    std::vector<uint32_t> want(kResults, 0);
    if (exists(k)) {
      ++users[k];
      want = {100 + k,
              Element::repeats(k) ? 200 + k : 1,
              300 + k,
              400 + k,
              500 + k,
              Element::words(k),
              (5 + k) * 100 + 4 + k,
              0};
    }
    if (exists(mirrored)) want[7] = 100 + mirrored;
    const std::vector<uint32_t> got(results.begin() + n * kResults, results.begin() + (n + 1) * kResults);
    ASSERT_EQ(got, want) << "stage " << stage << " invocation " << n << " index " << k;
  }
  for (uint32_t k = 0; k < arrays.count; ++k) {
    const bool used = users[k] != 0;
    std::vector<uint32_t> texels(4 + k, 300 + k), words = Element::storage_words(k);
    texels[1] += users[k];
    if (used) texels[2] = k + 1;
    EXPECT_EQ(from_bytes<uint32_t>(download(subject(), elements[k].image, 4)), texels) << stage << ' ' << k;
    words[0] = users[k];
    if (used) words[3] = k + 1;
    EXPECT_EQ(words_of(elements[k].storage), words_of(Element::buffer(words, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)))
        << stage << ' ' << k;
  }
}

constexpr VkShaderStageFlagBits kStages[] = {VK_SHADER_STAGE_COMPUTE_BIT, VK_SHADER_STAGE_VERTEX_BIT,
                                             VK_SHADER_STAGE_FRAGMENT_BIT};

TEST(ArrayIndexing, IsOffered) {
  VkPhysicalDeviceFeatures features;
  vkGetPhysicalDeviceFeatures(subject().physical_device(), &features);
  EXPECT_EQ(features.shaderUniformBufferArrayDynamicIndexing, VK_TRUE);
  EXPECT_EQ(features.shaderSampledImageArrayDynamicIndexing, VK_TRUE);
  EXPECT_EQ(features.shaderStorageBufferArrayDynamicIndexing, VK_TRUE);
  EXPECT_EQ(features.shaderStorageImageArrayDynamicIndexing, VK_TRUE);
}

TEST(ArrayIndexing, TheSameIndexInAllInvocations) {
  for (const VkShaderStageFlagBits stage : kStages) {
    for (const bool dynamic : {false, true}) {
      for (uint32_t k = 0; k < kDeclared; ++k)
        expect_arrays({.count = kDeclared, .dynamic = dynamic}, stage, std::vector<uint32_t>(kInvocations, k));
    }
  }
}

// Not promised by the features; here every invocation has its own index, and wrong ones read 0 or, in arrays that are
// longer than the shader says, what is there.
TEST(ArrayIndexing, AnyIndex) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "needs descriptor indexing";
  constexpr uint32_t kIndices[] = {0, 1, 2, 3, 4, 5, 6, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x20000001};
  std::vector<uint32_t> indices;
  for (uint32_t n = 0; n < kInvocations; ++n) indices.push_back(kIndices[n * 7 % std::size(kIndices)]);
  for (const VkShaderStageFlagBits stage : kStages) {
    for (const bool dynamic : {false, true}) {
      expect_arrays({.count = kDeclared, .dynamic = dynamic}, stage, indices);
      expect_arrays({.count = 5, .dynamic = dynamic, .missing = 1}, stage, indices);
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
