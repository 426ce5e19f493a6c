# To be sourced before mpirun on a laptop or in a container: lets Open MPI run as root and with more ranks than cores.
if [ "$(id -u)" = 0 ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
# More ranks than cores, bound to none, giving way while they wait: Open MPI 4, then 5, which starts them by PRRTE.
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
export OMPI_MCA_btl_vader_single_copy_mechanism=none # containers often forbid it, with a warning per rank (Open MPI 4)
export OMPI_MCA_reachable=weighted # what asks the kernel for routes warns where a host has none to itself (Open MPI 5)
export PMIX_MCA_gds=hash # without locks in shared memory: a rank killed while it holds one leaves mpirun hanging at its end
