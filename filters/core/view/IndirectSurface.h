#pragma once

#include "core/math/Types.h"

#include <cstdint>
#include <vector>

/// \file IndirectSurface.h
/// A quantity that varies smoothly over a plane, known at a few points.

namespace vantage
{

/// Where the quantity is wanted.
struct SurfaceSpot
{
  Vec2 place;          ///< in the plane
  double weight = 0.0; ///< of an error here, >= 0
  std::uint32_t index; ///< the spot's name
};

/// A wall that stands on the plane: the two sides of it have nothing to do with each other.
struct Foot
{
  Vec2 from, to;
  bool fromIsFree = true; ///< there is a way around this end
  bool toIsFree = true;
};

/// A quadtree over spots of a plane. Each leaf, a cell, has one of its spots as its point, where
/// the quantity is measured: so no point lies where there is no spot. Around each point the
/// quantity is modelled by a plane fitted to the points near it, which also tells how wrong the
/// model would be had that point not been measured; between points the models are blended smoothly.
class IndirectSurface
{
public:
  struct Cell
  {
    Vec2 low{ 0.0 };
    double size = 0.0;
    std::uint32_t first = 0; ///< its spots, in the order of this surface
    std::uint32_t last = 0;
    std::uint32_t point = 0;   ///< the spot that was chosen
    double weight = 0.0;       ///< of its spots
    std::uint32_t effort = 1;  ///< to measure it with, in units of the usual one
    std::uint32_t samples = 0; ///< that the measurement took; 0: not measured
    Color value{ 0.0 };
    double noise = 0.0; ///< standard error of the value, mean of channels
    /// Root mean square over the points around it, each weighted as in the fit, mean of channels:
    double noiseAround = 0.0; ///< of their noise
    double surprise = 0.0;    ///< of how far they are from the fit
  };

  /// Cells with no more than `mostSpots` spots.
  IndirectSurface(std::vector<SurfaceSpot> spots, std::vector<Foot> feet, std::size_t mostSpots);

  std::vector<Cell>& Cells() { return this->Leaves; }
  const std::vector<Cell>& Cells() const { return this->Leaves; }
  const SurfaceSpot& Spot(std::uint32_t i) const { return this->Spots[i]; }

  /// Fits the models, on all threads of the arena, unless no cell is new or measured again.
  /// \pre all cells are measured
  void Fit();

  /// Error that the cell adds beyond its noise, weight times what the model is wrong by, if cutting
  /// the cell can mend it: 0 for a cell of a few spots.
  static double ModelError(const Cell& cell);

  /// Cuts cells in four whose model error is not below the limit, > 0. \return how many were cut
  std::size_t Refine(double limit);

  /// Wants cells to be measured again with four times the effort, up to `mostEffort`, where the
  /// noise is more than a part of the value, or times the weight not below a limit. \return how
  /// many
  std::size_t Doubt(double relativeNoise, double noise, std::uint32_t mostEffort);

  /// Values at all spots, written to values[spot.index], on all threads. \pre fitted
  void Evaluate(Color* values) const;

private:
  struct Model
  {
    Color value{ 0.0 }, alongX{ 0.0 }, alongY{ 0.0 };
    double reach = 0.0;          ///< where the weight of the model ends
    std::uint32_t firstFoot = 0; ///< walls within reach
    std::uint32_t lastFoot = 0;
  };

  /// A model that reaches into a cell.
  struct Reaching
  {
    Vec2 place;
    double inverseSquare; ///< of the reach
    const Model* model;
  };

  void ChoosePoint(Cell& cell) const;
  std::vector<Cell> Quarter(const Cell& cell);
  void FitAt(std::size_t cell);
  void EvaluateIn(const Cell& cell, Color* values) const;
  Vec2 PlaceOf(const Cell& cell) const { return this->Spots[cell.point].place; }
  void CloseFeet();
  void DropIdleFeet();
  void FindFeet(Model& model, const Vec2& place);
  std::vector<Reaching> ReachingInto(const Cell& cell) const;
  double Openness(const Vec2& a, const Vec2& b, const Model& model) const;

  std::vector<SurfaceSpot> Spots;
  std::vector<Foot> Feet;
  std::vector<Foot> FeetOfModels;
  std::vector<Cell> Leaves;
  std::vector<Model> Models;
  bool IsFitted = false;
};

} // namespace vantage
