function dualdamp_write(file, text)
% Writes a text to a file.
  id = fopen(file, 'w');
  if id < 0
    error('dualdamp:output', 'cannot write %s', file);
  end
  fwrite(id, unicode2native(text, 'UTF-8'));
  fclose(id);
end
