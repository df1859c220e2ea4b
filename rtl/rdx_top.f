-F rdx.f
../build/csr/rdx_csr_regs_pkg.sv
../build/csr/rdx_csr_regs.sv
rdx_csr.sv
rdx_top.sv
