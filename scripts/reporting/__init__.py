# SPDX-License-Identifier: Apache-2.0
"""The report page: pictures (`gallery`), test results (`results`), tables and plots of the docs (`documents`)."""
