// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil on the liner below a pad, remembered in cells that are fixed to the liner.
#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "core/base/matrix.hpp"
#include "dynamics/film/film_extent.hpp"
#include "dynamics/film/oil_content.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// The layer on the liner below the cells of one pad that are not full.
///
/// Oil in a gap that is not full rests on one of its walls. Carried from cell to cell of the skirt
/// it would be mixed over a cell in each step; here it lies in cells of the liner, several to a row
/// of the pad, and what nothing touches does not change at all. The film's flux over a face past
/// which only such oil slides is therefore known before the stage is solved (`slide`): it depends
/// neither on the fills nor on the gap.
///
/// A cell of the pad is dry when it is not full and is entirely inside the liner and outside of
/// recesses. Of the others, and of faces past which some of them slide, the film keeps its own law;
/// the liner below them has the layer of that law, Reynolds::profile().
///
/// The contents of the cells remain those of the film, so that the balance of oil is theirs: what
/// is not on the liner, S = m - L, rests on the skirt. After an accepted step (`advance`) the liner
/// takes from the skirt and gives to it until it has min(m, c/2), on the mean of each of its cells;
/// the closure of Cavity::kLayer. Face by face instead of on these means each step, however short,
/// would move oil towards the smaller gap.
class CoveredLayer {
 public:
  /// `pad` is read while this is used.
  explicit CoveredLayer(const PadFaces& pad);

  /// The run begins: no cell is dry until the first accepted step. `profile` as Reynolds'.
  void start(const Eigen::ArrayXd& profile);
  /// Volumes that slide over faces and rims when the pad has moved by `travel` [m] in the step, in
  /// the gap of this stage: what the edges meet comes in as it lies where the gap takes all of it.
  const KnownFlows& slide(double travel, const FilmCells& film, const FilmStage& stage);
  /// An accepted step in which the pad moved by `travel` [m], with its last solution and what it
  /// `moved`. Moves oil between neighbouring cells of `content` [m], n: what lies on one cell of
  /// the liner is spread over it.
  void advance(double travel, const Reynolds& film, const OilContent& moved,
               Eigen::ArrayXd& content);

  /// The state as numbers.
  void save(std::vector<double>& state) const;
  size_t saved_size() const;
  /// Takes `saved_size()` numbers from `next` on; returns where they end. `profile` as at start().
  std::vector<double>::const_iterator restore(std::vector<double>::const_iterator next,
                                              const Eigen::ArrayXd& profile);

 private:
  /// Pieces of a column between edges of its cells and of those of the liner.
  struct Pieces {
    std::vector<double> edge;     // ascending [m], one more than pieces
    std::vector<int> liner, row;  // cells of each piece
    std::vector<int> first;       // piece above each edge of a row, rows + 1
    int count() const { return static_cast<int>(row.size()); }
    double width(int piece) const { return edge[piece + 1] - edge[piece]; }
  };
  /// A position among pieces.
  struct Position {
    int piece;
    double part;    // of the piece, below 0 or above 1 beyond the pad
    double beyond;  // distance outside of the pad [m], signed
  };
  void cut(double offset, Pieces& all) const;
  Position find(double z) const;
  double thickness(int column, int piece) const;
  double volume_below(int column, const Position& at, double beyond) const;
  void lay_out(const Eigen::ArrayXd& profile);
  void meet(double shift, const FilmCells& film, const FilmStage& stage);
  std::pair<int, int> passing(int j, const Position& from, double shift) const;
  bool all_dry(int column, std::pair<int, int> rows) const;
  void slide_past(int j, const Position& from, double shift, double speed);
  void bring(int column, double shift, const Eigen::ArrayXd& carried);
  void exchange(int column, const FilmCells& film, Eigen::ArrayXd& content);
  void spread(int column, const Eigen::ArrayXd& held, const Eigen::ArrayXd& storage,
              Eigen::ArrayXd& content);

  const PadFaces& pad_;
  const PadGrid& grid_;
  FilmExtent extent_;
  int cells_;               // of the liner below the pad and beside its edges
  double step_;             // height of one [m]
  Eigen::ArrayXd heights_;  // of the rows of the pad [m]
  double offset_ = 0.0;     // of the first one's lower edge from the pad's [m], -step_ to 0
  RowMatrix held_;          // on the part below dry cells, per width, n_angle x cells_ [m2]
  std::vector<char> dry_;   // by cell, at the start of the step
  Pieces pieces_, next_;    // at the start of the step, and after it
  RowMatrix below_;         // oil below each edge of the pieces, per width, n_angle x edges [m2]
  RowMatrix on_liner_;      // on each new piece, per width, n_angle x pieces [m2]
  std::vector<Position> from_;  // where edges of the new pieces were
  Eigen::MatrixXi wet_below_;   // cells that are not dry below each edge of a row, n_angle x edges
  std::vector<Eigen::Index> lower_, upper_;  // flows over the rims of each column; -1: a wall
  KnownFlows known_;
  Eigen::ArrayXd met_;                         // by column [m]
  Eigen::ArrayXd have_, free_, want_, offer_;  // by cells of the liner
  std::array<Eigen::ArrayXd, 4> of_row_;
};

}  // namespace clatter::film
