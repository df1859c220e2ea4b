# SPDX-License-Identifier: Apache-2.0
"""How far a rendered frame is from the ideal scene: the numbers of the accuracy table."""

from dataclasses import asdict, dataclass

import numpy as np


@dataclass(frozen=True)
class DepthErrors:
    """Comparison of two frames of one scene; errors are NaN if no pixel is a hit in both.

    pixels      pixels of the frame
    hit         pixels where the rendered frame has a hit
    silhouette  pixels where one frame has a hit and the other a miss
    other       pixels where both hit, but different surfaces
    rms, p999, max              |depth - ideal depth| over all pixels where both hit, scene units: root mean
                                square, 99.9th percentile, largest
    ulp                         one ulp of t in scene units, largest over the surfaces seen in those pixels
    ulp_rms, ulp_p999, ulp_max  the same errors, each in ulp of the surface in that pixel
    """

    pixels: int
    hit: int
    silhouette: int
    other: int
    rms: float
    p999: float
    max: float
    ulp: float
    ulp_rms: float
    ulp_p999: float
    ulp_max: float

    def as_json(self):
        """A dictionary without NaN (None instead), for JSON."""
        return {key: None if value != value else value for key, value in asdict(self).items()}


def depth_errors(frame, ideal):
    """Compare a rendered frame with the ideal one.

    frame: depth float64 (H, W), surface int16 (H, W), ulp float64 (number of surfaces,) in scene units.
    ideal: depth and surface likewise (`raydix.oracle.IdealFrame`). A miss is surface -1.
    Where two surfaces meet the frames may see different ones: such a pixel is counted (`other`) and its depth
    error, in ulp of the coarser of the two, is part of the statistics like any other.
    """
    if frame.depth.shape != ideal.depth.shape:
        raise ValueError(f"frames of different size: {frame.depth.shape} and {ideal.depth.shape}")
    hit, wanted = frame.surface >= 0, ideal.surface >= 0
    both = hit & wanted
    error = np.abs(frame.depth[both] - ideal.depth[both])
    ulp_of = np.asarray(frame.ulp, dtype=np.float64)
    ulp = np.maximum(ulp_of[frame.surface[both]], ulp_of[ideal.surface[both]])
    rms, p999, largest = _statistics(error)
    ulp_rms, ulp_p999, ulp_largest = _statistics(error / ulp)
    return DepthErrors(
        pixels=hit.size,
        hit=int(hit.sum()),
        silhouette=int((hit != wanted).sum()),
        other=int((frame.surface[both] != ideal.surface[both]).sum()),
        rms=rms,
        p999=p999,
        max=largest,
        ulp=float(ulp.max()) if ulp.size else float("nan"),
        ulp_rms=ulp_rms,
        ulp_p999=ulp_p999,
        ulp_max=ulp_largest,
    )


def _statistics(error):
    """Root mean square, 99.9th percentile and largest of an array of magnitudes; NaN if it is empty."""
    if error.size == 0:
        return (float("nan"),) * 3
    return float(np.sqrt(np.mean(error**2))), float(np.percentile(error, 99.9)), float(error.max())
