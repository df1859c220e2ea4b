# SPDX-License-Identifier: Apache-2.0
"""Design points of the intersection engines: which there are, what each takes and gives, which are best."""
