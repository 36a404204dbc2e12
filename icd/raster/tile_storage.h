// The tile of every attachment of a pass: where its texels are while they are worked on, and which blocks of them are
// there. A block that nobody touches is never moved; one that was only cleared is cleared in the image itself.
// Specification: chapter "Render Pass", Render Pass Load Operations, Store Operations.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "image/tile.h"
#include "raster/coverage.h"
#include "raster/render_pass.h"

namespace lapilli {

// An attachment with its clear value packed.
struct PassAttachment {
  const AttachmentTarget* target = nullptr;
  uint32_t color_index = 0;
  bool is_depth = false;
  PackedTexel clear = {};
};

class TileStorage {
 public:
  // Room for these attachments. Planes lie sample by sample.
  void reserve(std::span<const PassAttachment> attachments, uint32_t samples);
  // Starts a tile: `area` in pixels of the image. First and last: of the sets of bins that the pass is made of.
  void begin_tile(const TileArea& area, bool first_set, bool last_set);

  std::byte* plane(size_t attachment, uint32_t sample) {
    return memory_.get() + (attachment * samples_ + sample) * kPlaneBytes;
  }
  // Whether the attachment's contents are its clear value until somebody writes to it.
  bool begins_cleared(size_t attachment) const {
    return first_set_ && attachments_[attachment].target->load_op == VK_ATTACHMENT_LOAD_OP_CLEAR;
  }

  // Brings colours of these blocks into the planes, unless they are there.
  void fetch_colors(uint64_t blocks) {
    if ((blocks & ~colors_present_) != 0) fetch_missing_colors(blocks & ~colors_present_);
  }
  // The blocks' colours are going to be written in every pixel of the area.
  void overwrite_colors(uint64_t blocks) { colors_present_ |= blocks; }
  void fetch_all(size_t attachment);

  bool stores(size_t attachment) const {
    return !last_set_ || attachments_[attachment].target->store_op != VK_ATTACHMENT_STORE_OP_DONT_CARE;
  }
  // Colours, each block where it has to go.
  void store_colors();
  // The plane's `blocks`, and the clear value in the others if there is one.
  void store(size_t attachment, uint64_t blocks);

 private:
  static constexpr size_t kPlaneBytes = kTileTexels * 16;  // the largest texel has 16 bytes
  struct Free {
    void operator()(std::byte* memory) const;
  };
  enum class Move { load, fill_plane, store, fill_image };

  void fetch_missing_colors(uint64_t blocks);
  void move_blocks(size_t attachment, uint64_t blocks, Move move);
  void move(size_t attachment, uint32_t sample, const TileArea& area, Move move);

  std::span<const PassAttachment> attachments_;
  uint32_t samples_ = 1;
  std::unique_ptr<std::byte[], Free> memory_;
  size_t capacity_ = 0;

  TileArea area_;
  bool first_set_ = true, last_set_ = true;
  uint64_t colors_present_ = 0;
};

}  // namespace lapilli
