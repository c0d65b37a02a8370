#pragma once

#include "core/goal/Link.h"

#include <array>
#include <vector>

/// \file LinkMatrix.h
/// The matrix that links stand for.

namespace vantage
{

/// Something for each kind.
template <typename T>
using OfKinds = std::array<T, LinkKinds.size()>;

/// The factors d of every node, for each kind of links: see RowClosure.h.
using Closure = OfKinds<std::vector<double>>;

/// F of all nodes of a tree: what a link brings is constant over its end and reaches all leaves
/// below it, what it takes is the mean of them (Hanrahan, Salzman and Aupperle 1991). Closing rows
/// and solving multiply by it some forty times a round, so it is packed: 24 bytes a link, and what
/// products have to know of nodes. It is a copy: links and areas that change later change nothing.
///
/// Nodes may rest (LinkSet.h): they have no rows, so what is multiplied by the matrix is read at
/// them and nothing is found for them.
class LinkMatrix
{
public:
  struct Leaf
  {
    OpenId id;
    double area;
    Color reflection; ///< albedo / pi
  };

  struct Row
  {
    OpenId id;
    OpenId parent; ///< None of the root
  };

  /// `resting` of each node; none rests when it is empty. `links` are all that have an end which
  /// does not rest. O(links + nodes).
  LinkMatrix(
    const OpenTree& tree, const std::vector<Link>& links, const std::vector<bool>& resting = {});

  OpenId Size() const { return static_cast<OpenId>(this->Areas.size()); }
  /// The nodes that do not rest; ids ascend.
  const std::vector<Row>& Rows() const { return this->AllRows; }
  /// Those of them that are leaves; ids ascend.
  const std::vector<Leaf>& Leaves() const { return this->AllLeaves; }

  /// For every row i the sum over links of a kind of F_ik values_k, those of its ancestors
  /// included. O(links + nodes).
  template <typename T>
  std::vector<T> Times(LinkKind kind, const std::vector<T>& values) const;

  /// Gives every row of an inner node the mean of its leaves, weighted by area; those without area
  /// keep what they have. O(rows).
  template <typename T>
  void AverageUp(std::vector<T>& values) const;

private:
  struct Entry
  {
    OpenId a, b;
    double ofA, ofB; ///< F_ab and F_ba; of a link of a node with itself, once
  };
  struct Inner
  {
    OpenId id, firstChild, endOfChildren;
    double area;
  };

  OfKinds<std::vector<Entry>> Entries;
  std::vector<Row> AllRows;
  std::vector<double> Areas; ///< of all nodes
  std::vector<Leaf> AllLeaves;
  std::vector<Inner> Inners; ///< ids descend
};

template <typename T>
std::vector<T> LinkMatrix::Times(LinkKind kind, const std::vector<T>& values) const
{
  std::vector<T> products(this->Size(), T(0.0));
  for (const Entry& entry : this->Entries[kind])
  {
    products[entry.a] += entry.ofA * values[entry.b];
    products[entry.b] += entry.ofB * values[entry.a];
  }
  for (const Row& row : this->AllRows)
  {
    if (row.parent != None)
    {
      products[row.id] += products[row.parent];
    }
  }
  return products;
}

template <typename T>
void LinkMatrix::AverageUp(std::vector<T>& values) const
{
  for (const Inner& inner : this->Inners)
  {
    T sum(0.0);
    for (OpenId child = inner.firstChild; child < inner.endOfChildren; ++child)
    {
      sum += this->Areas[child] * values[child];
    }
    values[inner.id] = sum / inner.area;
  }
}

} // namespace vantage
