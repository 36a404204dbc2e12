// Render passes: load and store operations, and the call of the renderer once for each subpass.
#include <algorithm>

#include "base/log.h"
#include "queue/command_executor.h"

namespace lapilli {
namespace {

VkRect2D clip(const VkRect2D& area, const Framebuffer& framebuffer) {
  const int64_t left = std::clamp<int64_t>(area.offset.x, 0, framebuffer.width);
  const int64_t top = std::clamp<int64_t>(area.offset.y, 0, framebuffer.height);
  const int64_t right = std::clamp<int64_t>(int64_t{area.offset.x} + area.extent.width, left, framebuffer.width);
  const int64_t bottom = std::clamp<int64_t>(int64_t{area.offset.y} + area.extent.height, top, framebuffer.height);
  return {{static_cast<int32_t>(left), static_cast<int32_t>(top)},
          {static_cast<uint32_t>(right - left), static_cast<uint32_t>(bottom - top)}};
}

bool uses(const Subpass& subpass, uint32_t attachment) {
  return subpass.depth == attachment || std::ranges::find(subpass.color, attachment) != subpass.color.end() ||
         std::ranges::find(subpass.input, attachment) != subpass.input.end();
}

// Whether a later subpass uses it, so that its contents have to survive this one.
bool used_later(const PassState& pass, uint32_t attachment) {
  for (size_t i = size_t{pass.subpass} + 1; i < pass.pass->subpasses.size(); ++i) {
    if (uses(pass.pass->subpasses[i], attachment)) return true;
  }
  return false;
}

VkClearValue clear_value(const PassState& pass, uint32_t attachment) {
  return attachment < pass.clear_values.size() ? pass.clear_values[attachment] : VkClearValue{};
}

// Load operations of what the renderer does not see: input attachments, and layers above the first.
void load_directly(PassState& pass, uint32_t attachment, uint32_t first_layer) {
  if (attachment == kUnusedAttachment || pass.loaded[attachment]) return;
  if (pass.pass->attachments[attachment].loadOp != VK_ATTACHMENT_LOAD_OP_CLEAR) return;
  const uint32_t layers = pass.framebuffer->layers;
  if (layers <= first_layer) return;
  clear_rectangle(*pass.framebuffer->attachments[attachment], pass.area, first_layer, layers - first_layer,
                  clear_value(pass, attachment));
}

// Also of a framebuffer made for another render pass: then it has to have the same attachments.
bool fits(const RenderPass& pass, const Framebuffer& framebuffer) {
  if (pass.attachments.size() != framebuffer.attachments.size()) return false;
  for (size_t i = 0; i < pass.attachments.size(); ++i) {
    const ImageView& view = *framebuffer.attachments[i];
    if (view.format->format != pass.attachments[i].format || view.image->data == nullptr) return false;
  }
  return true;
}

void begin_subpass(PassState& pass) {
  const Subpass& subpass = pass.pass->subpasses[pass.subpass];
  for (uint32_t attachment : subpass.color) load_directly(pass, attachment, 1);
  load_directly(pass, subpass.depth, 1);
  for (uint32_t attachment : subpass.input) {
    const bool also_target =
        attachment == subpass.depth || std::ranges::find(subpass.color, attachment) != subpass.color.end();
    if (attachment == kUnusedAttachment || also_target) continue;
    load_directly(pass, attachment, 0);
    pass.loaded[attachment] = true;
  }
}

AttachmentTarget target_of(PassState& pass, uint32_t attachment, bool end_of_subpass) {
  if (attachment == kUnusedAttachment) return {};
  const VkAttachmentDescription& description = pass.pass->attachments[attachment];
  const ImageView& view = *pass.framebuffer->attachments[attachment];
  const ImageLayout& layout = view.image->layout;
  const uint32_t level = view.range.baseMipLevel;
  AttachmentTarget target;
  target.data = view.image->data + texel_offset(layout, level, view.range.baseArrayLayer);
  target.format = view.format;
  target.row_pitch = layout.levels[level].row_pitch;
  target.load_op = pass.loaded[attachment] ? VK_ATTACHMENT_LOAD_OP_LOAD : description.loadOp;
  target.store_op =
      end_of_subpass && !used_later(pass, attachment) ? description.storeOp : VK_ATTACHMENT_STORE_OP_STORE;
  target.clear = clear_value(pass, attachment);
  pass.loaded[attachment] = true;
  return target;
}

}  // namespace

void flush_pass(CommandExecutor& executor, bool end_of_subpass) {
  PassState& pass = executor.pass;
  if (executor.result != VK_SUCCESS) return;
  const Subpass& subpass = pass.pass->subpasses[pass.subpass];
  AttachmentTarget color[kMaxColorAttachments];
  for (size_t i = 0; i < subpass.color.size(); ++i) color[i] = target_of(pass, subpass.color[i], end_of_subpass);
  PassTarget target;
  target.width = pass.framebuffer->width;
  target.height = pass.framebuffer->height;
  target.render_area = pass.area;
  target.color = std::span(color, subpass.color.size());
  target.depth = target_of(pass, subpass.depth, end_of_subpass);

  ExecutionLimits limits;
  executor.start(limits);
  if (!executor.renderer) executor.renderer.emplace(executor.pool);
  const VkResult result = executor.renderer->render(target, pass.draws, limits);
  if (result != VK_SUCCESS) {
    executor.fail(result, result == VK_ERROR_DEVICE_LOST ? "a shader ran past the time limit"
                                                         : "out of memory for a render pass");
  }
  pass.draws.clear();
  for (const auto& [pool, query] : pass.ended_queries) pool->make_available(query);
  pass.ended_queries.clear();
  executor.drop_blocks();
}

void execute(CommandExecutor& executor, const cmd::BeginRenderPass& command) {
  PassState& pass = executor.pass;
  pass.pass = nullptr;
  pass.draws.clear();
  executor.drop_blocks();
  if (!fits(*command.pass, *command.framebuffer)) return log_error("the framebuffer does not fit the render pass");
  pass.pass = command.pass;
  pass.framebuffer = command.framebuffer;
  pass.area = clip(command.area, *command.framebuffer);
  pass.clear_values = command.clear_values;
  pass.subpass = 0;
  pass.loaded.assign(command.pass->attachments.size(), false);
  begin_subpass(pass);
}

void execute(CommandExecutor& executor, const cmd::NextSubpass&) {
  PassState& pass = executor.pass;
  if (pass.pass == nullptr || pass.subpass + 1 >= pass.pass->subpasses.size()) return;
  flush_pass(executor, true);
  ++pass.subpass;
  begin_subpass(pass);
}

void execute(CommandExecutor& executor, const cmd::EndRenderPass&) {
  if (executor.pass.pass == nullptr) return;
  flush_pass(executor, true);
  executor.pass.pass = nullptr;
}

}  // namespace lapilli
