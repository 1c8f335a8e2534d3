function text = dualdamp_text(value)
% A quantity as text; a number reads back to the same bits.
  if ischar(value)
    text = value;
  else
    text = sprintf('%.17g', value);
  end
end
