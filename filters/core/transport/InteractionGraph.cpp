#include "core/transport/InteractionGraph.h"

#include <algorithm>

namespace vantage
{

InteractionId InteractionGraph::Add(const ElementTree& tree, const Interaction& interaction)
{
  const InteractionId id = this->Size();
  this->All.push_back(interaction);
  this->PatchesOf.push_back({ tree[interaction.ends[0]].patch, tree[interaction.ends[1]].patch });
  for (const PatchId patch : this->PatchesOf.back())
  {
    this->OfPatch[patch].ids.push_back(id);
  }
  ++this->Active;
  return id;
}

void InteractionGraph::Retire(InteractionId id)
{
  this->All[id].isActive = false;
  for (const PatchId patch : this->PatchesOf[id])
  {
    this->OfPatch[patch].hasRetired = true;
  }
  --this->Active;
}

const std::vector<InteractionId>& InteractionGraph::Of(PatchId patch)
{
  PatchList& list = this->OfPatch[patch];
  if (list.hasRetired)
  {
    const auto gone = [this](InteractionId id) { return !this->All[id].isActive; };
    list.ids.erase(std::remove_if(list.ids.begin(), list.ids.end(), gone), list.ids.end());
    list.hasRetired = false;
  }
  return list.ids;
}

std::size_t InteractionGraph::Bytes() const
{
  std::size_t bytes = this->All.capacity() * sizeof(Interaction) +
                      this->PatchesOf.capacity() * sizeof(this->PatchesOf[0]);
  for (const PatchList& list : this->OfPatch)
  {
    bytes += sizeof(PatchList) + list.ids.capacity() * sizeof(InteractionId);
  }
  return bytes;
}

} // namespace vantage
