#include "physics/pile/row_list.h"

#include <algorithm>

namespace careen {

void RowList::clear() {
  blocks_.clear();
  rows_.clear();
  blockOfRow_.clear();
}

void RowList::begin(RowBlock block) {
  block.first = static_cast<int>(rows_.size());
  block.count = 0;
  blocks_.push_back(block);
}

void RowList::add(const PileRow& row) {
  rows_.push_back(row);
  blockOfRow_.push_back(static_cast<int>(blocks_.size()) - 1);
  ++blocks_.back().count;
}

void RowList::reserve(Extent all) {
  blocks_.resize(at(all.blocks));
  rows_.resize(at(all.rows));
  blockOfRow_.resize(at(all.rows));
}

void RowList::setBlock(int index, const RowBlock& block) {
  blocks_[at(index)] = block;
  std::fill_n(blockOfRow_.begin() + block.first, block.count, index);
}

}  // namespace careen
