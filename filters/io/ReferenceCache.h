#pragma once

#include "core/reference/ReferenceImage.h"

#include <string>

/// \file ReferenceCache.h
/// References that are made once.

namespace vantage
{

/// What MakeReference() gives, from a folder of OpenEXR files when it is there; else it is made and
/// stored. The name is for people, the key is ReferenceKey(). The folder is made when it is
/// missing. \throw InputError when the files cannot be read or written, and what `progress` throws.
ReferenceImage CachedReference(const std::string& folder, const std::string& name,
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings = {},
  const ReferenceProgress& progress = {});

} // namespace vantage
