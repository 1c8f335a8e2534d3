function dualdamp_remove(place)
% Removes a directory of ours.
  if exist(place, 'dir')
    if exist('OCTAVE_VERSION', 'builtin'), confirm_recursive_rmdir(false, 'local'); end
    rmdir(place, 's');
  end
end
