#pragma once

#include "core/scene/Scene.h"
#include "support/ReferenceImage.h"

#include <cstdint>
#include <string>
#include <vector>

/// \file StudyScenes.h
/// The scenes by which methods are judged: each is hard for another reason.

namespace vantage::test
{

/// A scene and the view of it that is judged.
struct StudyScene
{
  std::string name;
  Scene scene;
  std::string camera;
  ReferenceSettings reference = {}; ///< with which its reference has a noise of some tenths of a
                                    ///< percent at most

  /// For square images.
  Camera View() const;
};

/// A labyrinth of so many rooms, as near to a square as that number allows. \pre rooms > 0
Scene MakeLabyrinthOf(int rooms, std::uint64_t seed);

/// The polygons of a scene that reach into the cube around a point, with all materials.
Scene PartAround(const Scene& scene, const Vec3& centre, double distance);

/// The labyrinth of 20 rooms of seeds 1 to 3, views 1 and 2: many rooms, few seen.
StudyScene MakeLabyrinthStudy(std::uint64_t seed, int view);

/// A room and a narrow chamber beside it that join at a slit of 40 cm. The only lamp is in the
/// chamber, with its back to the slit: no direct light reaches the view.
Scene MakeGapRoom();

/// Four walls around blocks under the open sky; two lamps.
Scene MakeCourtyard();

/// Blocks and a lamp on a plane, nothing around.
Scene MakeFreeBlocks();

/// Two wings of a gallery at right angles, with two rows of columns. The view looks along one wing,
/// the stronger lamps are in the other.
Scene MakeGallery();

/// A room with a table, a lamp of 1 cm over it and a ceiling panel of 3 x 3 m.
Scene MakeUnequalLamps();

/// A room with balls of 1,300 and 2,200 triangles, a bent screen of 160 quadrilaterals and, beside
/// a ceiling panel, a globe of 120 triangles that shines.
Scene MakeRoundBodies();

/// A room lit by what modellers make of lamps: four globes of 224 triangles over a table, three
/// round panels of 24 and a tube of 48 facets.
Scene MakeLuminaires();

/// A hall of 30 x 20 m with screens and blocks and 200 lamps whose powers lie two decades apart.
Scene MakeLampHall();

/// The names of the fixed scenes, in the order of the tables.
std::vector<std::string> StudySceneNames();

/// One of them, or "room-N": MakeRandomRoom(N). \throw UnknownNameError
StudyScene MakeStudyScene(const std::string& name);

} // namespace vantage::test
