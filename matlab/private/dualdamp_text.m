function text = dualdamp_text(name, value)
% A quantity as text; a number reads back to the same bits.
  if ischar(value)
    text = value;
  elseif isnumeric(value) && ~(isreal(value) && isscalar(value))
    error('dualdamp:usage', '%s is one real number, or a text with a unit', name);
  else
    text = sprintf('%.17g', value);
  end
end
